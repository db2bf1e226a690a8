#!/usr/bin/env bash
# Parts that are left out of a build: their sources are not in it, the user's flags are, warnings are no errors, and flags that hide NaN are
# refused. With FLOE_PARTS set (nightly) the rest is built, runs, and says of what is missing how to have it.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"
off=(-DFLOE_STUDIES=OFF -DFLOE_PICTURES=OFF -DFLOE_VERIFICATION=OFF)
expect 0 cmake -G Ninja -S "$FLOE_SOURCE" -B small "${off[@]}" -DCMAKE_C_FLAGS='-O2 -g'
commands=small/compile_commands.json
for part in src/study src/batch exact_riemann cmd_study; do
    grep -q "$part" $commands && fault "$part is in a build without it"
done
for part in src/library src/cli/absent_studies src/verify/norms; do
    grep -q "$part" $commands || fault "$part is not in a build without studies and verification"
done
grep -q -- '-O2 -g' $commands || fault "the user's flags are not in the build"
grep -qE -- '-O3|-Werror' $commands && fault "the build has an -O3 or a -Werror that the user did not ask for"
expect 0 cmake -G Ninja -S "$FLOE_SOURCE" -B bare "${off[@]}" -DFLOE_CLI=OFF
grep -q src/cli bare/compile_commands.json && fault 'the command line is in a build without it'
expect 1 cmake -G Ninja -S "$FLOE_SOURCE" -B fast -DCMAKE_C_FLAGS=-ffast-math
has stderr 'NaN and infinity'
[ -n "${FLOE_PARTS:-}" ] || exit 0

for build in small bare; do
    expect 0 cmake --build $build -j2
    expect 0 cmake --install $build --prefix "$work/$build-prefix"
done
FLOE=$work/small-prefix/bin/floe
expect 0 "$FLOE" run "$FLOE_SOURCE/inputs/sod.yaml" --set verify=null --quiet -o out
expect 2 "$FLOE" study "$FLOE_SOURCE/inputs/sod.yaml"
has stderr FLOE_STUDIES=ON
expect 4 "$FLOE" picture out
has stderr FLOE_PICTURES=ON
[ ! -e "$work/small-prefix/share/floe/python" ] || fault "python/floe is in a build without it"
expect 2 "$FLOE" check "$FLOE_SOURCE/inputs/sod.yaml"
has stderr 'in this build of floe'
PKG_CONFIG_PATH=$(dirname "$(find bare-prefix -name floe.pc)")
export PKG_CONFIG_PATH
read -ra flags < <(pkg-config --cflags --libs floe)
expect 0 cc -std=c11 "$FLOE_SOURCE/examples/sod_steps.c" -o sod_steps "${flags[@]}" -lm
expect 0 env LD_LIBRARY_PATH="$(pkg-config --variable=libdir floe)" ./sod_steps
