# The point kernels of mpm: one generated file for each geometry, basis and width of lanes, which instantiates
# mpm/kernels_body.h, and one with the tables of them. The bases are those of the files src/mpm/basis/basis_<name>.c.

# floe_point_kernels(module), before the module's floe_module.
function(floe_point_kernels module)
    set(geometries line plane axisymmetric solid)
    set(dimensions 1 2 2 3)
    set(about_axis false false true false)
    file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_SOURCE_DIR}/src/${module}/basis/basis_*.c")
    list(TRANSFORM sources REPLACE ".*/basis_([a-z0-9_]+)\\.c" "\\1" OUTPUT_VARIABLE bases)

    set(directory "${CMAKE_BINARY_DIR}/generated/${module}")
    set(declarations "")
    set(tables "")
    foreach(width IN ITEMS pairs quads)
        string(APPEND tables "\nconst kernel_set *const kernels_table_${width}[KERNEL_SPACES][BASIS_KINDS] = {\n")
        foreach(geometry dim axi IN ZIP_LISTS geometries dimensions about_axis)
            string(TOUPPER "${geometry}" space)
            foreach(basis IN LISTS bases)
                string(TOUPPER "${basis}" kind)
                set(name "kernels_${geometry}_${basis}_${width}")
                file(CONFIGURE OUTPUT "${directory}/${name}.c" @ONLY CONTENT "/* Generated. */
#include \"mpm/kernels_body.h\"

POINT_KERNELS(@geometry@, @dim@, @axi@, @basis@, BASIS_@kind@, @width@)
")
                set_property(GLOBAL APPEND PROPERTY FLOE_GENERATED_${module} "${directory}/${name}.c")
                if(width STREQUAL "quads" AND FLOE_HAS_QUADS) # other instructions, the same bits
                    set_source_files_properties("${directory}/${name}.c" PROPERTIES COMPILE_OPTIONS -mavx2)
                endif()
                string(APPEND declarations "extern const kernel_set ${name};\n")
                string(APPEND tables "    [KERNELS_${space}][BASIS_${kind}] = &${name},\n")
            endforeach()
        endforeach()
        string(APPEND tables "};\n")
    endforeach()
    file(CONFIGURE OUTPUT "${directory}/kernels_table.c" @ONLY CONTENT "/* Generated. */
#include \"mpm/kernels.h\"

@declarations@@tables@")
    set_property(GLOBAL APPEND PROPERTY FLOE_GENERATED_${module} "${directory}/kernels_table.c")
endfunction()
