# Flags of every floe target, as the interface library floe_flags.
add_library(floe_flags INTERFACE)
target_link_libraries(floe_flags INTERFACE OpenMP::OpenMP_C Threads::Threads m)
target_compile_options(floe_flags INTERFACE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wstrict-prototypes -Wmissing-prototypes
    -Wvla $<$<BOOL:${FLOE_WERROR}>:-Werror>
    $<$<C_COMPILER_ID:GNU>:-Wdouble-promotion>
    # a * b + c is two operations on every machine: results do not depend on which has them in one.
    -ffp-contract=off
    # clang takes the C library's INFINITY, a float, for one, and says which loops it could not vectorise.
    $<$<C_COMPILER_ID:Clang>:-Wno-pass-failed>)
if(FLOE_SANITIZE)
    target_compile_options(floe_flags INTERFACE
        -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(floe_flags INTERFACE -fsanitize=address,undefined)
    set(FLOE_EXTRA_FLAGS "${FLOE_EXTRA_FLAGS} -fsanitize=address,undefined")
endif()
if(FLOE_SANITIZE_THREADS)
    target_compile_options(floe_flags INTERFACE -fsanitize=thread -fno-omit-frame-pointer -g)
    target_link_options(floe_flags INTERFACE -fsanitize=thread)
    set(FLOE_EXTRA_FLAGS "${FLOE_EXTRA_FLAGS} -fsanitize=thread")
endif()
if(FLOE_FUZZ)
    # The fuzzers' own link adds libFuzzer's main (tests/fuzz).
    target_compile_options(floe_flags INTERFACE -fsanitize=fuzzer-no-link -g)
    set(FLOE_EXTRA_FLAGS "${FLOE_EXTRA_FLAGS} -fsanitize=fuzzer-no-link")
endif()
if(FLOE_COVERAGE)
    # Counters that threads share: without atomic updates some lines would seem not to have run.
    target_compile_options(floe_flags INTERFACE --coverage -fprofile-update=atomic)
    target_link_options(floe_flags INTERFACE --coverage)
    set(FLOE_EXTRA_FLAGS "${FLOE_EXTRA_FLAGS} --coverage")
endif()
if(FLOE_NATIVE)
    target_compile_options(floe_flags INTERFACE -march=native)
    set(FLOE_EXTRA_FLAGS "${FLOE_EXTRA_FLAGS} -march=native")
endif()
# Kernels in several versions, chosen as floe is loaded (FLOE_WIDE of base/compiler.h): where compiler, linker and loader know how. Sanitizers
# and counters are not up yet when the choice is made; builds for checks and for one machine have no use for it.
include(CheckCSourceCompiles)
check_c_source_compiles("
    __attribute__((target_clones(\"arch=x86-64-v4\", \"arch=x86-64-v3\", \"default\"))) double twice(double x);
    double twice(double x) { return x + x; }
    int main(void) { return twice(0.0) > 0.0; }" FLOE_HAS_CLONES)
set(FLOE_CLONES OFF)
if(FLOE_HAS_CLONES AND CMAKE_C_COMPILER_ID STREQUAL "GNU" AND CMAKE_BUILD_TYPE STREQUAL "Release" AND
   NOT FLOE_SANITIZE AND NOT FLOE_SANITIZE_THREADS AND NOT FLOE_FUZZ AND NOT FLOE_COVERAGE AND NOT FLOE_NATIVE)
    set(FLOE_CLONES ON)
    target_compile_definitions(floe_flags INTERFACE FLOE_CLONES=1)
endif()
# Kernels for registers of four doubles, chosen as a scene is made (base/compiler.h).
include(CheckCCompilerFlag)
check_c_compiler_flag(-mavx2 FLOE_HAS_QUADS)
if(FLOE_HAS_QUADS)
    target_compile_definitions(floe_flags INTERFACE FLOE_QUADS=1)
endif()
