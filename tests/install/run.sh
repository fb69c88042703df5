#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# run.sh BUILD: installs the build folder BUILD, moves the prefix into a path with a space, and builds
# games and a simulation with it in each documented way: oiler new, find_package, pkg-config, subproject.
set -Eeuo pipefail
build=$(cd "$1" && pwd)
here=$(cd "$(dirname "$0")" && pwd)
source=$(cd "$here/../.." && pwd)
folder=$build/install_test
rm -rf "$folder"
mkdir "$folder"
log=$folder/log
trap 'rm -rf "$folder"' EXIT
trap 'echo "failed in line $LINENO, after:"; tail -n 40 "$log"' ERR
unset OILER_INSTRUCTIONS PKG_CONFIG_PATH CMAKE_PREFIX_PATH DISPLAY WAYLAND_DISPLAY
unset CI JENKINS_URL  # where they are set, no new project writes its golden frames
CMAKE_BUILD_PARALLEL_LEVEL=$(nproc)
export CMAKE_BUILD_PARALLEL_LEVEL
# Builds of the engine that compile little.
quick=(-DCMAKE_BUILD_TYPE=Release "-DCMAKE_CXX_FLAGS_RELEASE=-O2 -DNDEBUG" -DOILER_KERNELS=none)
if command -v ccache > /dev/null; then
    quick+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache -DCMAKE_C_COMPILER_LAUNCHER=ccache)
fi

fail() {
    echo "$*"
    tail -n 40 "$log"
    exit 1
}
quietly() { "$@" > "$log" 2>&1; }
# expect_failure TEXT COMMAND...: the command fails, and its output has the text.
expect_failure() {
    local text=$1
    shift
    if quietly "$@"; then fail "succeeds: $*"; fi
    tr -s '\n ' '  ' < "$log" | grep -qF -- "$text" || fail "does not say \"$text\": $*"
}
# not_in_cache PATTERN BUILD: nothing that matches was looked for.
not_in_cache() {
    if grep -iE "$1" "$2/CMakeCache.txt"; then fail "$2 looks for the above"; fi
}
no_window() {
    local libraries
    libraries=$(ldd "$1")
    grep -q libc.so <<< "$libraries" || fail "ldd prints no libraries: $libraries"
    if grep -E 'SDL|libGL|libEGL|OSMesa|libX|libxcb|wayland|deflate|toml' <<< "$libraries"; then
        fail "$1 links the above"
    fi
}
# draws PROGRAM: the frames of hello, byte for byte.
draws() {
    rm -rf "$folder/frames"
    quietly "$1" --headless --frames 3 --size 320x180 --out "$folder/frames"
    for frame in "$folder"/expected/*.png; do cmp "$frame" "$folder/frames/$(basename "$frame")"; done
}

quietly "$build/bin/hello" --headless --frames 3 --size 320x180 --out "$folder/expected"
[ "$(find "$folder/expected" -name '*.png' | wc -l)" = 3 ] || fail "hello draws no 3 frames"

quietly cmake --install "$build" --prefix "$folder/installed"
mkdir "$folder/moved here"
prefix="$folder/moved here/oiler"
mv "$folder/installed" "$prefix"
for place in "$build" "$source/" "$folder/installed"; do
    if grep -rlF -- "$place" "$prefix"; then fail "the above have the absolute path $place"; fi
done
# A compiler's cache may have compiled them in another folder.
if grep -rlE '/engine/oiler/[a-z_/]+\.cpp' "$prefix"; then
    fail "the above have the path of a source file"
fi
config=$(dirname "$(find "$prefix" -name oiler-config.cmake)")
libraries=$(dirname "$(dirname "$config")")
"$prefix/bin/oiler" --version > /dev/null
quietly "$prefix/bin/oiler" check "$prefix/share/oiler/scenes/article_spring.toml"
draws "$prefix/libexec/oiler/hello"
"$prefix/bin/oiler" demos > "$folder/demos"
grep -q '^  jump  ' "$folder/demos" && grep -q '^  orbit.toml  ' "$folder/demos" ||
    fail "oiler demos lists $(cat "$folder/demos")"
quietly "$prefix/bin/oiler" demos hello --steps 3
[ ! -e "$prefix/include/oiler/cli" ] || fail "the headers of the program are installed"
[ "$(find "$prefix/share/doc/oiler/licences" -type f | wc -l)" = 8 ] || fail "licences are missing"

echo "a project of oiler new: the commands that it prints"
"$prefix/bin/oiler" new "$folder/my games/cannon" > "$folder/new"
project="$folder/my games/cannon"
grep -qF "installed in $prefix." "$folder/new" || fail "oiler new says: $(cat "$folder/new")"
sed -n 's/^    //p' "$folder/new" > "$folder/commands"
[ "$(wc -l < "$folder/commands")" = 2 ] || fail "oiler new prints no two commands"
quietly bash -euc ". '$folder/commands'"
not_in_cache 'SDL|GLAD|CLI11|nlohmann|Eigen' "$project/build"
[ -s "$project/frames/cannon/frame_000239.png" ] || fail "the game draws no frames"
[ -s "$project/tests/golden/cannon/manifest.json" ] || fail "the test writes no golden frames"

echo "a project of oiler new: its test, also in CI and without local.cmake"
rm -r "$project/build" "$project/frames" "$project/local.cmake"
configure_project() { cmake -S "$project" -B "$project/build" "$@"; }
test_project() { CI=true ctest --test-dir "$project/build" --output-on-failure --no-tests=error; }
PATH="$prefix/bin:$PATH" quietly configure_project
quietly cmake --build "$project/build"
quietly test_project
[ -s "$project/frames/cannon.xml" ] || fail "the test writes no JUnit file"
sed -i 's/stiffness = 12,/stiffness = 13,/' "$project/game.cpp"
quietly cmake --build "$project/build"
expect_failure "simulation changed at tick" test_project
[ -s "$project/frames/cannon-differences/index.html" ] || fail "there is no page of differences"
rm -r "$project/tests/golden"
expect_failure "a job that updates its golden always passes" test_project

echo "a project of oiler new with the source: its engine is a subproject"
"$build/bin/oiler" new "$folder/my games/compiled" > "$folder/new"
grep -qF "compiles the Oiler in $source:" "$folder/new" || fail "oiler new says: $(cat "$folder/new")"
quietly cmake -G Ninja -S "$folder/my games/compiled" -B "$folder/compiled"
quietly ninja -C "$folder/compiled" -n
grep -q liboiler_app.a "$log" || fail "ninja -n does not build the engine"

cp -r "$here/program" "$here/subproject" "$here/simulation.cpp" "$here/version.cpp" "$folder"
cp "$source/demos/hello.cpp" "$folder/game.cpp"
program=$folder/program/build/program
# configure NAME...: the project of the program NAME.cpp
configure() {
    local name=$1
    shift
    rm -rf "$folder/program/build"
    cmake -S "$folder/program" -B "$folder/program/build" -DCMAKE_BUILD_TYPE=Release \
        -DSOURCE="$folder/$name.cpp" "$@"
}
make_program() {
    quietly configure "$@"
    quietly cmake --build "$folder/program/build"
}

echo "a game by oiler_DIR, all components"
make_program game -Doiler_DIR="$config"
draws "$program"

echo "requests that cannot be met"
expect_failure "oiler has no component wurld; its components are: core math" \
    configure game -DCMAKE_PREFIX_PATH="$prefix" -DCOMPONENTS=wurld
expect_failure "compatible with requested version \"0.2\"" \
    configure game -DCMAKE_PREFIX_PATH="$prefix" -DOILER_VERSION=0.2
expect_failure "oiler::core needs libxxhash" \
    env PKG_CONFIG_LIBDIR="$folder" cmake -S "$folder/program" -B "$folder/program/without" \
    -DCMAKE_PREFIX_PATH="$prefix"

echo "a simulation by component world"
make_program simulation -DCMAKE_PREFIX_PATH="$prefix" -DCOMPONENTS=world
not_in_cache 'SDL|OpenGL|GLAD|CLI11|nlohmann|Eigen|deflate|toml' "$folder/program/build"
no_window "$program"
position=$("$program")

echo "pkg-config"
# compile NAME MODULE: with flags in which pkg-config has escaped the space.
compile() {
    local flags
    flags=$(PKG_CONFIG_PATH="$libraries/pkgconfig" pkg-config --cflags --libs "$2")
    eval "g++ -std=c++20 -O1 -o '$folder/$1' '$folder/$1.cpp' $flags"
}
quietly compile game oiler
draws "$folder/game"
quietly compile simulation oiler-world
no_window "$folder/simulation"
[ "$("$folder/simulation")" = "$position" ]

echo "the installed headers"
(cd "$prefix/include" && find oiler -name '*.hpp') | sed 's/.*/#include <&>/' > "$folder/headers.cpp"
[ "$(wc -l < "$folder/headers.cpp")" -gt 80 ] || fail "few headers are installed"
echo 'int main() {}' >> "$folder/headers.cpp"
quietly compile headers oiler

echo "a subproject of one room"
subproject=$folder/subproject/build
quietly cmake -S "$folder/subproject" -B "$subproject" -DOILER_SOURCE="$source" \
    -DOILER_ROOMS=core "${quick[@]}"
not_in_cache 'SDL|OpenGL|GLAD|CLI11|nlohmann|deflate|toml|^CPACK_|GTest' "$subproject"
quietly cmake --build "$subproject"
no_window "$subproject/core"
version=$("$subproject/core")
[[ "$("$prefix/bin/oiler" --version)" == *"$version"* ]] || fail "the version is $version"
quietly cmake --install "$subproject" --prefix "$folder/nothing"
[ ! -e "$folder/nothing" ] || fail "a subproject installs: $(find "$folder/nothing")"

echo "a subproject that simulates, with all rooms of a game there"
quietly cmake -G Ninja -S "$folder/subproject" -B "$folder/subproject/all" -DOILER_SOURCE="$source"
quietly ninja -C "$folder/subproject/all" -n
grep -q liboiler_world.a "$log" || fail "ninja -n names no library"
if grep -E 'liboiler_(app|render|platform|capture|plot|picture).a' "$log"; then
    fail "a build makes the above, which it does not link"
fi

echo "an absolute folder of libraries"
absolute=$folder/absolute
quietly cmake -S "$source" -B "$folder/world" -DOILER_ROOMS=world "${quick[@]}" \
    -DOILER_BUILD_DEMOS=OFF -DCMAKE_INSTALL_PREFIX="$absolute" -DCMAKE_INSTALL_LIBDIR="$absolute/lib"
quietly cmake --build "$folder/world"
quietly cmake --install "$folder/world"
make_program simulation -DCMAKE_PREFIX_PATH="$absolute" -DCOMPONENTS=world
[ "$("$program")" = "$position" ]
mv "$absolute" "$folder/moved here/absolute"
libraries="$folder/moved here/absolute/lib"
quietly compile simulation oiler-world
[ "$("$folder/simulation")" = "$position" ]
