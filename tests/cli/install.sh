#!/usr/bin/env bash
# cmake --install into an empty prefix: the program, the man page and the decks are there and work, and the examples build
# against what is installed and run a deck.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"
build=$(dirname "$FLOE")
prefix=$work/prefix
expect 0 cmake --install "$build" --prefix "$prefix"
is_there "$prefix/bin/floe" "$prefix/include/floe/floe.h" "$prefix/share/man/man1/floe.1" "$prefix/share/floe/inputs/sod.yaml"

# A library made with sanitizers asks the same, and the same compiler's, of what links to it.
flags=(-std=c11 -Wall -Wextra -Werror)
cc=cc
sanitizers=$("$FLOE" --version | grep -oE -e '-fsanitize=[a-z,]+' || true)
[ -n "$sanitizers" ] && flags+=("$sanitizers")
"$FLOE" --version | grep -q '^Clang' && cc=clang

pc=$(find "$prefix" -name floe.pc)
PKG_CONFIG_PATH=$(dirname "$pc")
export PKG_CONFIG_PATH
libdir=$(pkg-config --variable=libdir floe)
read -ra floe_flags < <(pkg-config --cflags --libs floe)
[ "$(pkg-config --modversion floe)" = "$("$prefix/bin/floe" --version | sed -n '1s/floe \([^ ]*\).*/\1/p')" ] ||
    fault 'pkg-config and floe --version differ'

# The headers stand by themselves, and a moved tree still works: nothing of the source or build tree is needed.
mv "$prefix" "$work/moved"
export PKG_CONFIG_PATH=${PKG_CONFIG_PATH/"$prefix"/"$work/moved"} LD_LIBRARY_PATH=${libdir/"$prefix"/"$work/moved"}
read -ra floe_flags < <(pkg-config --cflags --libs floe)
expect 0 "$cc" "${flags[@]}" "$FLOE_SOURCE/examples/run_deck.c" -o run_deck "${floe_flags[@]}" -lm
expect 0 ./run_deck "$work/moved/share/floe/inputs/sod.yaml" out domain.cell=0.05
has stdout 'done'
has stdout 'errors.l1_density'
is_there out/summary.json out/fields.xdmf
expect 1 ./run_deck "$work/moved/share/floe/inputs/sod.yaml" other domain.cel=0.05
has stderr 'domain.cel'

# Stepped by a program, and with a law of its own: each compares a number with an exact solution, or with floe's own law.
expect 0 "$cc" "${flags[@]}" "$FLOE_SOURCE/examples/sod_steps.c" -o sod_steps "${floe_flags[@]}" -lm
expect 0 ./sod_steps
has stdout 't = 0.200'

# Pictures and pages by the moved program, with the package that is beside it.
if python_is_whole; then
    expect 0 env FLOE_PYTHON="$python" "$work/moved/bin/floe" picture out -o out.png
    is_there out.png
    mv "$work/moved/share/floe/python/floe/command.py" kept
    echo 'def main(): return 5' >"$work/moved/share/floe/python/floe/command.py"
    expect 5 env FLOE_PYTHON="$python" "$work/moved/bin/floe" picture out
    mv kept "$work/moved/share/floe/python/floe/command.py"
fi

# The CMake package of the moved tree, as a project of its own uses it.
mkdir project
cat >project/CMakeLists.txt <<EOF
cmake_minimum_required(VERSION 3.22)
project(uses_floe LANGUAGES C)
find_package(floe REQUIRED)
add_executable(own_law $FLOE_SOURCE/examples/own_law.c)
target_link_libraries(own_law PRIVATE floe::floe m)
EOF
expect 0 cmake -G Ninja -S project -B project/build -DCMAKE_PREFIX_PATH="$work/moved" -DCMAKE_C_COMPILER="$cc" -DCMAKE_C_FLAGS="$sanitizers"
expect 0 cmake --build project/build
expect 0 project/build/own_law
has stdout 'strain energy 877.6'

# HDF5 by either of its names.
hdf5=hdf5-serial
pkg-config --exists "$hdf5" || hdf5=hdf5
read -ra hdf5_flags < <(pkg-config --cflags --libs "$hdf5")
expect 0 cc -std=c11 "$FLOE_SOURCE/examples/snapshot_to_text.c" -o snapshot_to_text "${hdf5_flags[@]}"
expect 0 ./snapshot_to_text out/fields/000000.h5 cells density_gas pressure
[ "$(wc -l <stdout)" -eq 20 ] || fault 'not a line a cell'
has stdout '0.025 0 0 1 1'
expect 1 ./snapshot_to_text out/fields/000000.h5 cells nothing

if command -v man >/dev/null; then expect 0 env MANPATH= man --warnings -l "$work/moved/share/man/man1/floe.1"; fi
