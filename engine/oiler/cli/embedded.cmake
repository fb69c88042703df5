# SPDX-License-Identifier: MIT
# Embeds the page of `oiler report`, the library that draws its charts, and the project of `oiler new`.
find_file(OILER_CHART_LIBRARY chart.min.js PATHS /usr/share/javascript/chart.js
          /usr/share/nodejs/chart.js/dist NO_DEFAULT_PATH)
if(NOT OILER_CHART_LIBRARY)
  message(FATAL_ERROR "chart.min.js not found: install the Debian package libjs-chart.js")
endif()
set(target oiler_cli)
set(assets ${PROJECT_SOURCE_DIR}/assets)
set(embed page ${CMAKE_CURRENT_SOURCE_DIR}/report.html
          chart ${OILER_CHART_LIBRARY}
          project_lists ${assets}/project/CMakeLists.txt
          project_game ${assets}/project/game.cpp
          project_frames ${assets}/project/tests/frames.sh
          project_play ${assets}/project/tests/play.txt
          project_ignore ${assets}/project/.gitignore
          project_github ${assets}/ci/github.yml
          project_gitlab ${assets}/ci/gitlab.yml)
include(${OILER_ENGINE}/cmake/embed.cmake)
