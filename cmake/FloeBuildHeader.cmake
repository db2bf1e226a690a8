# floe_build.h: version, git hash, compiler and flags, for the modules that report them. Remade at every build, written
# only when it changes, so that a commit recompiles no more than its readers.
string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type)
string(STRIP "-std=c11 ${CMAKE_C_FLAGS} ${CMAKE_C_FLAGS_${build_type}} ${FLOE_EXTRA_FLAGS}" flags)
string(REGEX REPLACE " +" " " flags "${flags}")

set(FLOE_BUILD_HEADER_DIR "${CMAKE_BINARY_DIR}/generated/build")
add_custom_target(floe_build_header
    COMMAND ${CMAKE_COMMAND}
        "-DSOURCE=${CMAKE_SOURCE_DIR}"
        "-DOUTPUT=${FLOE_BUILD_HEADER_DIR}/floe_build.h"
        "-DFLOE_VERSION=${PROJECT_VERSION}"
        "-DFLOE_COMPILER=${CMAKE_C_COMPILER_ID} ${CMAKE_C_COMPILER_VERSION}"
        "-DFLOE_FLAGS=${flags}"
        -P "${CMAKE_SOURCE_DIR}/cmake/write_build_header.cmake"
    BYPRODUCTS "${FLOE_BUILD_HEADER_DIR}/floe_build.h"
    COMMENT "" VERBATIM)
