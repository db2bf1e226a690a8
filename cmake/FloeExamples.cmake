# The examples of docs/extending.md, each a whole file, compiled as the page has them and tested by the batteries of their kind.

# floe_example_source(out file): the code that the page has for `file`, written to the build folder.
function(floe_example_source out file)
    set(page "${CMAKE_SOURCE_DIR}/docs/extending.md")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${page}")
    set(output "${CMAKE_BINARY_DIR}/examples/${file}")
    get_filename_component(directory "${output}" DIRECTORY)
    file(MAKE_DIRECTORY "${directory}")
    execute_process(
        COMMAND awk -v "want=`${file}`:" [[
            on && /^    / { print substr($0, 5); next }
            on && /^$/ { print; next }
            { on = length($0) >= length(want) && substr($0, length($0) - length(want) + 1) == want }]] "${page}"
        OUTPUT_FILE "${output}.new" COMMAND_ERROR_IS_FATAL ANY)
    file(SIZE "${output}.new" size)
    if(size EQUAL 0)
        message(FATAL_ERROR "floe: docs/extending.md has no example '${file}'")
    endif()
    file(COPY_FILE "${output}.new" "${output}" ONLY_IF_DIFFERENT)
    set(${out} "${output}" PARENT_SCOPE)
endfunction()

# floe_example(folder prefix name header type BATTERIES tests...): the example src/<folder>/<prefix>_<name>.c with a registry that has it
# beside floe's own, and each battery with these two, asked of the example alone; the linker then takes neither from the archive.
function(floe_example folder prefix name header type)
    cmake_parse_arguments(PARSE_ARGV 5 example "" "" "BATTERIES")
    floe_example_source(source "src/${folder}/${prefix}_${name}.c")
    file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_SOURCE_DIR}/src/${folder}/${prefix}_*.c")
    list(TRANSFORM sources REPLACE ".*/${prefix}_([a-z0-9_]+)\\.c" "\\1" OUTPUT_VARIABLE names)
    list(APPEND names ${name})
    list(SORT names)
    list(LENGTH names size)
    set(declarations "")
    set(entries "")
    foreach(entry IN LISTS names)
        string(APPEND declarations "extern const ${type} ${prefix}_${entry};\n")
        string(APPEND entries "    &${prefix}_${entry},\n")
    endforeach()
    set(registry "${CMAKE_BINARY_DIR}/examples/${prefix}_registry.c")
    file(CONFIGURE OUTPUT "${registry}" @ONLY CONTENT "/* Generated. */
#include \"@header@\"

#include <stddef.h>

@declarations@
const @type@ *const @prefix@_registry[] = {
@entries@    NULL,
};
const size_t @prefix@_registry_size = @size@;
")
    foreach(battery IN LISTS example_BATTERIES)
        string(REGEX REPLACE ".*/test_" "" test "${battery}")
        floe_test(example_${prefix}_${test} SOURCES "${CMAKE_CURRENT_SOURCE_DIR}/${battery}.c" "${source}" "${registry}")
        set_property(TEST example_${prefix}_${test} APPEND PROPERTY ENVIRONMENT "FLOE_MODEL=${name}")
    endforeach()
endfunction()

# floe_example_basis(name BATTERIES tests...): the same of the one header of a basis, with its point kernels.
function(floe_example_basis name)
    cmake_parse_arguments(PARSE_ARGV 1 example "" "" "BATTERIES")
    floe_example_source(header "src/mpm/basis/basis_${name}.h")
    floe_basis_files("${CMAKE_BINARY_DIR}/examples/mpm" "${header}" files)
    add_library(floe_example_basis OBJECT ${files})
    target_include_directories(floe_example_basis BEFORE PRIVATE "${CMAKE_BINARY_DIR}/examples/mpm")
    target_include_directories(floe_example_basis PRIVATE "${FLOE_ALL_MODULES_DIR}")
    target_compile_definitions(floe_example_basis PRIVATE _POSIX_C_SOURCE=200809L)
    target_link_libraries(floe_example_basis PRIVATE floe_flags)
    foreach(battery IN LISTS example_BATTERIES)
        string(REGEX REPLACE ".*/test_" "" test "${battery}")
        floe_test(example_basis_${test} SOURCES "${CMAKE_CURRENT_SOURCE_DIR}/${battery}.c" $<TARGET_OBJECTS:floe_example_basis>)
    endforeach()
endfunction()
