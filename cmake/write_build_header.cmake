# Run by the target floe_build_header: writes OUTPUT from floe_build.h.in.
set(FLOE_GIT "unknown") # a source archive has no repository
execute_process(COMMAND git -C "${SOURCE}" rev-parse --short=12 HEAD
    OUTPUT_VARIABLE hash OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(NOT failed)
    set(FLOE_GIT "${hash}")
    execute_process(COMMAND git -C "${SOURCE}" diff --quiet HEAD -- src include cmake CMakeLists.txt CMakePresets.json
        RESULT_VARIABLE changed ERROR_QUIET)
    if(changed)
        string(APPEND FLOE_GIT "-modified")
    endif()
endif()
configure_file("${CMAKE_CURRENT_LIST_DIR}/floe_build.h.in" "${OUTPUT}" @ONLY)
