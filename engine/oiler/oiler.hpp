// SPDX-License-Identifier: MIT
#pragma once

// All headers of a game: a world to step, a picture of it, and run() to play it.
#include "oiler/app/run.hpp"
#include "oiler/picture/palette.hpp"
#include "oiler/picture/picture.hpp"
#include "oiler/picture/shapes.hpp"
#include "oiler/picture/text.hpp"
#include "oiler/picture/theme.hpp"
#include "oiler/world/collisions.hpp"
#include "oiler/world/neighbours.hpp"
#include "oiler/world/world.hpp"
