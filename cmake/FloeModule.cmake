# Modules: each folder of src is an object library that sees the headers of itself and of the modules on lower layers.
# The compiler is the judge: a module's only floe include directory holds links to what it may see, and nothing else.

# Layers, lowest first; the modules of one layer do not see each other.
set(FLOE_LAYERS
    "base math"
    "expression"
    "grid geom material"
    "surface embedded"
    "coupling scene solve"
    "mpm ice"
    "sim"
    "deck io verify"
    "run plot"
    "batch library"
    "study"
    "cli")
string(REPLACE " " ";" FLOE_ALL_MODULES "${FLOE_LAYERS}")

# Those that are built, and whether that is all of them.
set(FLOE_BUILT_MODULES ${FLOE_ALL_MODULES})
set(FLOE_WHOLE ON)
if(NOT FLOE_CLI)
    list(REMOVE_ITEM FLOE_BUILT_MODULES cli)
endif()
if(NOT FLOE_STUDIES)
    list(REMOVE_ITEM FLOE_BUILT_MODULES batch study)
endif()
if(NOT (FLOE_CLI AND FLOE_STUDIES AND FLOE_PICTURES AND FLOE_VERIFICATION))
    set(FLOE_WHOLE OFF)
endif()

# The modules below `module`, in `out`.
function(floe_modules_below module out)
    set(below "")
    foreach(layer IN LISTS FLOE_LAYERS)
        string(REPLACE " " ";" modules "${layer}")
        if(module IN_LIST modules)
            set(${out} "${below}" PARENT_SCOPE)
            return()
        endif()
        list(APPEND below ${modules})
    endforeach()
    message(FATAL_ERROR "floe: '${module}' is in no layer; see FLOE_LAYERS in cmake/FloeModule.cmake")
endfunction()

# Fills `directory` with links to the named modules and to the public headers; links of an earlier configure go first.
function(floe_link_modules directory)
    file(REMOVE_RECURSE "${directory}")
    file(MAKE_DIRECTORY "${directory}")
    foreach(module IN LISTS ARGN)
        file(CREATE_LINK "${CMAKE_SOURCE_DIR}/src/${module}" "${directory}/${module}" SYMBOLIC)
    endforeach()
    file(CREATE_LINK "${CMAKE_SOURCE_DIR}/include/floe" "${directory}/floe" SYMBOLIC)
endfunction()

# Every module at once, for the tests and the benchmarks.
set(FLOE_ALL_MODULES_DIR "${CMAKE_BINARY_DIR}/modules/all")
floe_link_modules("${FLOE_ALL_MODULES_DIR}" ${FLOE_ALL_MODULES})

# floe_parts(module part: others...), before the module's floe_module; one call a part, lowest first.
# A part is a folder src/<module>/<part> of a large module. Its sources see the module's own headers, the headers of their folder, and of the
# parts named after the colon one header each, <part>/<module>_<part>.h. The module's other sources see that one header of every part.
# In place of a part, single headers of it may stand, <other>/<name>.h, of any part: what a part shows is then a header a concern. For a part
# of the module's own name these are what its other sources see.
function(floe_parts module)
    string(REPLACE ";" " " line "${ARGN}")
    if(NOT line MATCHES "^([a-z_]+): *(.*)$")
        message(FATAL_ERROR "floe: floe_parts(${module} ${line}): write `part: others...`")
    endif()
    set(part "${CMAKE_MATCH_1}")
    string(REPLACE " " ";" seen "${CMAKE_MATCH_2}")
    get_property(parts GLOBAL PROPERTY FLOE_PARTS_${module})
    foreach(other IN LISTS seen)
        if(NOT other IN_LIST parts AND NOT other MATCHES "[.]h$")
            message(FATAL_ERROR "floe: part '${part}' of '${module}' would see '${other}', which is not a lower one")
        endif()
    endforeach()
    set_property(GLOBAL APPEND PROPERTY FLOE_PARTS_${module} ${part})
    set_property(GLOBAL PROPERTY FLOE_PARTS_${module}_${part} "${seen}")
endfunction()

# Fills `directory`/<module> with links to the module's own headers and to the one header of each named part.
function(floe_link_parts directory module)
    file(REMOVE "${directory}/${module}")
    file(MAKE_DIRECTORY "${directory}/${module}")
    file(GLOB headers CONFIGURE_DEPENDS "${CMAKE_SOURCE_DIR}/src/${module}/*.h")
    foreach(header IN LISTS headers)
        get_filename_component(name "${header}" NAME)
        file(CREATE_LINK "${header}" "${directory}/${module}/${name}" SYMBOLIC)
    endforeach()
    foreach(part IN LISTS ARGN)
        set(header "${module}/${part}/${module}_${part}.h")
        if(part MATCHES "[.]h$")
            set(header "${module}/${part}")
        endif()
        get_filename_component(folder "${directory}/${header}" DIRECTORY)
        file(MAKE_DIRECTORY "${folder}")
        file(CREATE_LINK "${CMAKE_SOURCE_DIR}/src/${header}" "${directory}/${header}" SYMBOLIC)
    endforeach()
endfunction()

# The object library of one part.
function(floe_part_library module part)
    get_property(seen GLOBAL PROPERTY FLOE_PARTS_${module}_${part})
    floe_modules_below(${module} below)
    set(include_dir "${CMAKE_BINARY_DIR}/modules/${module}.${part}")
    floe_link_modules("${include_dir}" ${below})
    list(FILTER seen EXCLUDE REGEX "^${part}/")
    floe_link_parts("${include_dir}" ${module} ${seen})
    file(CREATE_LINK "${CMAKE_SOURCE_DIR}/src/${module}/${part}" "${include_dir}/${module}/${part}" SYMBOLIC)
    file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_SOURCE_DIR}/src/${module}/${part}/*.c")
    add_library(floe_${module}_${part} OBJECT ${sources})
    target_include_directories(floe_${module}_${part} PRIVATE "${include_dir}")
    target_link_libraries(floe_${module}_${part} PRIVATE floe_flags)
    target_compile_definitions(floe_${module}_${part} PRIVATE _POSIX_C_SOURCE=200809L)
    set_property(GLOBAL APPEND PROPERTY FLOE_OBJECTS floe_${module}_${part})
endfunction()

# floe_module(name [LINK libraries...] [DEFINE definitions...] [BUILD_HEADER] [WITHOUT sources...])
# Makes the object library floe_<name> of src/<name>/*.c and src/<name>/*/*.c (where floe_parts has not named the folder), generated
# registries included.
# WITHOUT: names, without ".c", or patterns under src/<name>, of sources that are left out.
# LINK: third-party libraries. DEFINE: instead of _POSIX_C_SOURCE=200809L. BUILD_HEADER: the module reads floe_build.h.
# A module without a source file yet is no target, and nothing else notices.
function(floe_module name)
    cmake_parse_arguments(PARSE_ARGV 1 module "BUILD_HEADER" "" "LINK;DEFINE;WITHOUT")
    set_property(GLOBAL APPEND PROPERTY FLOE_LINK ${module_LINK})
    if(FLOE_MODULES AND NOT name IN_LIST FLOE_MODULES)
        return()
    endif()
    file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_SOURCE_DIR}/src/${name}/*.c" "${CMAKE_SOURCE_DIR}/src/${name}/*/*.c")
    foreach(source IN LISTS module_WITHOUT)
        list(FILTER sources EXCLUDE REGEX "/src/${name}/${source}[.]c$")
    endforeach()
    get_property(generated GLOBAL PROPERTY FLOE_GENERATED_${name})
    get_property(parts GLOBAL PROPERTY FLOE_PARTS_${name})
    get_property(shown GLOBAL PROPERTY FLOE_PARTS_${name}_${name})
    list(REMOVE_ITEM parts ${name})
    if(NOT shown)
        set(shown ${parts})
    endif()
    foreach(part IN LISTS parts)
        list(FILTER sources EXCLUDE REGEX "/src/${name}/${part}/")
        floe_part_library(${name} ${part})
    endforeach()
    if(name STREQUAL "cli" AND NOT EXISTS "${CMAKE_SOURCE_DIR}/src/cli/main.c")
        return()
    endif()
    if(NOT sources)
        return()
    endif()

    floe_modules_below(${name} below)
    set(include_dir "${CMAKE_BINARY_DIR}/modules/${name}")
    floe_link_modules("${include_dir}" ${name} ${below})
    if(parts)
        floe_link_parts("${include_dir}" ${name} ${shown})
    endif()

    set(target floe_${name})
    add_library(${target} OBJECT ${sources} ${generated})
    target_include_directories(${target} PRIVATE "${include_dir}")
    target_link_libraries(${target} PRIVATE floe_flags ${module_LINK})
    if(NOT module_DEFINE)
        set(module_DEFINE _POSIX_C_SOURCE=200809L)
    endif()
    target_compile_definitions(${target} PRIVATE ${module_DEFINE})
    if(module_BUILD_HEADER)
        target_include_directories(${target} PRIVATE "${FLOE_BUILD_HEADER_DIR}")
        add_dependencies(${target} floe_build_header)
    endif()
    if(NOT name STREQUAL "cli")
        set_property(GLOBAL APPEND PROPERTY FLOE_OBJECTS ${target})
    endif()
endfunction()

# floe_registry(module prefix header type [SUBDIR dir]), before the module's floe_module.
# One file adds one thing: every src/<module>/[dir/]<prefix>_<name>.c defines `const <type> <prefix>_<name>`, and the
# generated source defines, in alphabetical order of the names,
#     const <type> *const <prefix>_registry[];   const size_t <prefix>_registry_size;
# The header declares these two (extern) and the type. Without the header nothing is generated.
# Helpers that several such files share must not be named <prefix>_*.c.
function(floe_registry module prefix header type)
    cmake_parse_arguments(PARSE_ARGV 4 registry "" "SUBDIR" "")
    set(directory "${CMAKE_SOURCE_DIR}/src/${module}")
    if(registry_SUBDIR)
        string(APPEND directory "/${registry_SUBDIR}")
    endif()
    file(GLOB found CONFIGURE_DEPENDS "${CMAKE_SOURCE_DIR}/src/${header}")
    file(GLOB sources CONFIGURE_DEPENDS "${directory}/${prefix}_*.c")
    if(NOT found)
        return()
    endif()

    set(declarations "")
    set(entries "")
    foreach(source IN LISTS sources)
        get_filename_component(entry "${source}" NAME_WE)
        string(APPEND declarations "extern const ${type} ${entry};\n")
        string(APPEND entries "    &${entry},\n")
    endforeach()
    list(LENGTH sources size)
    set(output "${CMAKE_BINARY_DIR}/generated/${module}/${prefix}_registry.c")
    file(CONFIGURE OUTPUT "${output}" @ONLY CONTENT "/* Generated from the names of the source files. */
#include \"@header@\"

#include <stddef.h>

@declarations@
/* The NULL at the end is not counted; it lets an empty registry be an array. */
const @type@ *const @prefix@_registry[] = {
@entries@    NULL,
};
const size_t @prefix@_registry_size = @size@;
")
    set_property(GLOBAL APPEND PROPERTY FLOE_GENERATED_${module} "${output}")
endfunction()

# libfloe, its public headers, pkg-config file and CMake package; and floe_archive, the same objects for the executable and the tests.
function(floe_library)
    get_property(modules GLOBAL PROPERTY FLOE_OBJECTS)
    get_property(libraries GLOBAL PROPERTY FLOE_LINK)
    list(REMOVE_DUPLICATES libraries)
    set(objects "")
    foreach(module IN LISTS modules)
        list(APPEND objects $<TARGET_OBJECTS:${module}>)
    endforeach()

    set(archives ${libraries})
    list(TRANSFORM archives REPLACE "^${FLOE_HDF5}$" "${FLOE_HDF5_ARCHIVE}")
    add_library(floe_archive STATIC ${objects})
    target_link_libraries(floe_archive PUBLIC floe_flags ${archives})

    add_library(floe_shared SHARED ${objects})
    set_target_properties(floe_shared PROPERTIES OUTPUT_NAME floe VERSION ${PROJECT_VERSION}
        SOVERSION ${PROJECT_VERSION_MAJOR})
    set_target_properties(floe_shared PROPERTIES EXPORT_NAME floe)
    target_link_libraries(floe_shared PRIVATE floe_flags ${libraries})
    target_include_directories(floe_shared INTERFACE "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")

    install(TARGETS floe_shared EXPORT floe LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
    set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/floe")
    install(EXPORT floe NAMESPACE floe:: FILE floeTargets.cmake DESTINATION "${package_dir}")
    configure_package_config_file("${CMAKE_SOURCE_DIR}/cmake/floeConfig.cmake.in" "${CMAKE_BINARY_DIR}/floeConfig.cmake"
        INSTALL_DESTINATION "${package_dir}")
    write_basic_package_version_file("${CMAKE_BINARY_DIR}/floeConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
    install(FILES "${CMAKE_BINARY_DIR}/floeConfig.cmake" "${CMAKE_BINARY_DIR}/floeConfigVersion.cmake"
        DESTINATION "${package_dir}")
    install(DIRECTORY "${CMAKE_SOURCE_DIR}/include/floe" DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "*.h")
    # The pkg-config file finds its prefix from its own place, so that an installed tree may be moved.
    file(RELATIVE_PATH FLOE_PC_PREFIX "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
    configure_file("${CMAKE_SOURCE_DIR}/cmake/floe.pc.in" "${CMAKE_BINARY_DIR}/floe.pc" @ONLY)
    install(FILES "${CMAKE_BINARY_DIR}/floe.pc" DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endfunction()

# The command line, once it has a main.
function(floe_executable)
    if(NOT TARGET floe_cli)
        return()
    endif()
    add_executable(floe $<TARGET_OBJECTS:floe_cli>)
    target_link_libraries(floe PRIVATE floe_archive)
    add_dependencies(floe floe_shared) # so that what is installed is there once the program is
    install(TARGETS floe RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endfunction()
