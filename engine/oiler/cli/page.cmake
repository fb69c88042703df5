# SPDX-License-Identifier: MIT
# Embeds the page of `oiler report` and the library that draws its charts.
find_file(OILER_CHART_LIBRARY chart.min.js PATHS /usr/share/javascript/chart.js
          /usr/share/nodejs/chart.js/dist NO_DEFAULT_PATH)
if(NOT OILER_CHART_LIBRARY)
  message(FATAL_ERROR "chart.min.js not found: install the Debian package libjs-chart.js")
endif()
set(target oiler_cli)
set(embed page ${CMAKE_CURRENT_SOURCE_DIR}/report.html chart ${OILER_CHART_LIBRARY})
include(${OILER_ENGINE}/cmake/embed.cmake)
