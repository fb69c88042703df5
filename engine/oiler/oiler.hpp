// SPDX-License-Identifier: MIT
#pragma once

// All that a game includes: a world to step, a picture of it, and run() to play it.
#include "oiler/app/run.hpp"
#include "oiler/picture/palette.hpp"
#include "oiler/picture/picture.hpp"
#include "oiler/picture/shapes.hpp"
#include "oiler/world/world.hpp"
