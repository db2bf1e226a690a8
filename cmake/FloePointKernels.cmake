# The bases of mpm and their point kernels: of every file src/mpm/basis/basis_<name>.h the list of bases, the registry, and one
# file for each geometry and width of lanes, which instantiates mpm/transfer/kernels_body.h, with the tables of these.

# floe_basis_files(directory extra out): writes them to `directory`; `out` gets the names of the sources. With `extra`, a header that is
# not among floe's own, the list has it too, and the kernels are those of the extra basis alone, for the tables beside floe's own.
function(floe_basis_files directory extra out)
    file(GLOB headers CONFIGURE_DEPENDS "${CMAKE_SOURCE_DIR}/src/mpm/basis/basis_*.h")
    list(TRANSFORM headers REPLACE ".*/basis_([a-z0-9_]+)\\.h" "\\1" OUTPUT_VARIABLE bases)
    list(REMOVE_ITEM bases inline)
    set(instantiated ${bases})
    if(extra)
        string(REGEX REPLACE ".*/basis_([a-z0-9_]+)\\.h" "\\1" instantiated "${extra}")
        list(APPEND bases ${instantiated})
        list(SORT bases)
    endif()
    set(includes "")
    set(numbers "")
    set(names "")
    set(entries "")
    foreach(basis IN LISTS bases)
        if(extra AND basis STREQUAL instantiated)
            string(APPEND includes "#include \"${extra}\"\n")
        else()
            string(APPEND includes "#include \"mpm/basis/basis_${basis}.h\"\n")
        endif()
        string(APPEND numbers "BASIS_NUMBER_${basis}, ")
        string(APPEND names " WHAT(${basis})")
        string(APPEND entries "    &basis_${basis},\n")
    endforeach()
    file(CONFIGURE OUTPUT "${directory}/basis_list.h" @ONLY CONTENT "/* Generated from the names of the source files. */
#ifndef BASIS_LIST_H
#define BASIS_LIST_H

@includes@
enum { @numbers@BASES };
#define FOR_BASES(WHAT)@names@

#endif
")
    file(CONFIGURE OUTPUT "${directory}/basis_registry.c" @ONLY CONTENT "/* Generated from the names of the source files. */
#include \"basis_list.h\"

const basis_model *const basis_registry[] = {
@entries@    NULL,
};
const size_t basis_registry_size = BASES;
")
    set(files "${directory}/basis_registry.c" "${directory}/kernels_table.c")
    set(declarations "")
    set(tables "")
    set(geometries line plane axisymmetric solid)
    set(dimensions 1 2 2 3)
    set(about_axis false false true false)
    foreach(width IN ITEMS pairs quads)
        string(APPEND tables "\nconst kernel_set *const kernels_table_${width}[] = {\n")
        foreach(geometry dim axi IN ZIP_LISTS geometries dimensions about_axis)
            foreach(basis IN LISTS bases)
                set(name "kernels_${geometry}_${basis}_${width}")
                if(extra AND basis STREQUAL instantiated) # one width serves both tables
                    set(name "kernels_${geometry}_${basis}_pairs")
                endif()
                string(APPEND declarations "extern const kernel_set ${name};\n")
                string(APPEND tables "    &${name},\n")
                if(NOT basis IN_LIST instantiated OR (extra AND width STREQUAL "quads"))
                    continue()
                endif()
                file(CONFIGURE OUTPUT "${directory}/${name}.c" @ONLY CONTENT "/* Generated. */
#include \"mpm/transfer/kernels_body.h\"

POINT_KERNELS(@geometry@, @dim@, @axi@, @basis@, @width@)
")
                list(APPEND files "${directory}/${name}.c")
                if(width STREQUAL "quads" AND FLOE_HAS_QUADS) # other instructions, the same bits
                    set_source_files_properties("${directory}/${name}.c" PROPERTIES COMPILE_OPTIONS -mavx2)
                endif()
            endforeach()
        endforeach()
        string(APPEND tables "};\n")
    endforeach()
    file(CONFIGURE OUTPUT "${directory}/kernels_table.c" @ONLY CONTENT "/* Generated. */
#include \"mpm/transfer/kernels.h\"

@declarations@@tables@")
    set(${out} ${files} PARENT_SCOPE)
endfunction()

# floe_point_kernels(), before floe_module(mpm).
function(floe_point_kernels)
    floe_basis_files("${CMAKE_BINARY_DIR}/generated/mpm" "" files)
    set_property(GLOBAL APPEND PROPERTY FLOE_GENERATED_mpm ${files})
endfunction()
