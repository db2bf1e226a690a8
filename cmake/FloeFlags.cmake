# Flags of every floe target, as the interface library floe_flags.
add_library(floe_flags INTERFACE)
target_link_libraries(floe_flags INTERFACE OpenMP::OpenMP_C Threads::Threads m)
target_compile_options(floe_flags INTERFACE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wstrict-prototypes -Wmissing-prototypes
    -Wvla -Wdouble-promotion -Werror)
if(FLOE_SANITIZE)
    target_compile_options(floe_flags INTERFACE
        -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(floe_flags INTERFACE -fsanitize=address,undefined)
    set(FLOE_EXTRA_FLAGS "${FLOE_EXTRA_FLAGS} -fsanitize=address,undefined")
endif()
if(FLOE_NATIVE)
    target_compile_options(floe_flags INTERFACE -march=native)
    set(FLOE_EXTRA_FLAGS "${FLOE_EXTRA_FLAGS} -march=native")
endif()
