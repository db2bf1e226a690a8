#!/usr/bin/env bash
# The library from Python (floe.Scene): its structs are the headers', what it reads and steps is what floe does, errors come as exceptions.
# shellcheck source=tests/cli/lib.bash
. "$(dirname "$0")/lib.bash"
"$python" -c 'import numpy, h5py' 2>/dev/null || {
    echo 'skipped: no Python with numpy and h5py'
    exit 77
}
needs_plain_library
FLOE_LIBRARY=$(dirname "$FLOE")/libfloe.so
export FLOE_LIBRARY PYTHONPATH=$FLOE_SOURCE/python
is_there "$FLOE_LIBRARY"

# Sizes and places of the structs, by the compiler and by the package.
expect 0 "$python" - <<'END'
import ctypes
from floe import library
print("#include <floe/floe.h>\n#include <stdio.h>\nint main(void)\n{")
for name, struct in library.STRUCTS.items():
    print(f'    printf("{name} %zu\\n", sizeof({name}));')
    for field, _ in struct._fields_:
        print(f'    printf("{name}.{field} %zu\\n", offsetof({name}, {field}));')
print("    return 0;\n}")
with open("python.txt", "w") as file:
    for name, struct in library.STRUCTS.items():
        print(name, ctypes.sizeof(struct), file=file)
        for field, _ in struct._fields_:
            print(f"{name}.{field}", getattr(struct, field).offset, file=file)
END
mv stdout structs.c
expect 0 cc -std=c11 "-I$FLOE_SOURCE/include" structs.c -o structs
expect 0 ./structs
cmp stdout python.txt || fault 'the structs of floe/library.py are not those of the headers'
[ "$(wc -l <python.txt)" -gt 100 ] || fault 'too few structs'

expect 0 "$FLOE" run "$FLOE_SOURCE/inputs/sod.yaml" --coupling ice --set domain.cell=0.02 -o sod --quiet
expect 0 "$python" "$FLOE_SOURCE/tests/python/test_scene.py" sod
cat stdout
expect 0 "$python" "$FLOE_SOURCE/tests/python/test_laws.py"
cat stdout

# Without the library: one sentence, and what to do.
expect 1 env FLOE_LIBRARY="$work/none.so" "$python" -c 'import floe; floe.Scene("deck.yaml")'
tail -n 1 stderr >last
has last 'floe.library.LibraryError: libfloe.so.0 is not found'
has last 'build it (`scripts/build.sh release floe`) or install floe, or set FLOE_LIBRARY'
# One that is something else.
other=$("$python" -c 'import ctypes.util; print(ctypes.util.find_library("m"))')
expect 1 env FLOE_LIBRARY="$other" "$python" -c 'import floe; floe.Scene("deck.yaml")'
has stderr 'is no libfloe of release'
# Beside the package of an installed tree, wherever it is, and results need no library.
mkdir -p tree/lib tree/share/floe
cp -r "$FLOE_SOURCE/python" tree/share/floe/
cp "$FLOE_LIBRARY" tree/lib/libfloe.so.0
expect 0 env -u FLOE_LIBRARY PYTHONPATH="$work/tree/share/floe/python" "$python" -c 'import floe; print(floe.library.load()._name)'
has stdout "$work/tree/lib/libfloe.so.0"
expect 0 env FLOE_LIBRARY="$work/none.so" "$python" -c 'import floe; print(floe.Result("sod").summary["status"])'
has stdout 'done'
