# Third-party libraries: found here, linked by the modules that name them (docs/dependencies.md says why each).
find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(OpenMP REQUIRED COMPONENTS C)
pkg_check_modules(GSL REQUIRED IMPORTED_TARGET gsl>=2.7)
pkg_check_modules(FYAML REQUIRED IMPORTED_TARGET libfyaml>=0.7)
pkg_check_modules(UDUNITS REQUIRED IMPORTED_TARGET udunits)
pkg_check_modules(JANSSON REQUIRED IMPORTED_TARGET jansson>=2.13)
pkg_check_modules(CRYPTO REQUIRED IMPORTED_TARGET libcrypto>=3.0)
# Pictures, plots and pages are made by Python when they are asked for; nothing is linked.
find_program(FLOE_PYTHON NAMES python3 HINTS /usr/bin NO_CMAKE_PATH NO_SYSTEM_ENVIRONMENT_PATH DOC "Python that makes pictures, plots and pages; FLOE_PYTHON of the environment comes first")
if(NOT FLOE_PYTHON)
    set(FLOE_PYTHON python3)
endif()
# The serial library by name: plain "hdf5" may be the MPI one where both are installed.
pkg_check_modules(HDF5 IMPORTED_TARGET hdf5-serial)
if(HDF5_FOUND)
    find_library(FLOE_HDF5_FILE NAMES libhdf5.a HINTS ${HDF5_LIBRARY_DIRS} NO_CACHE)
else()
    pkg_check_modules(HDF5 REQUIRED IMPORTED_TARGET hdf5)
endif()
find_package(SUNDIALS 6.4 REQUIRED COMPONENTS nvecserial sunlinsoldense sunmatrixdense sunnonlinsolfixedpoint cvode)

# Short names for the modules' LINK lists.
set(FLOE_GSL PkgConfig::GSL)
set(FLOE_FYAML PkgConfig::FYAML)
set(FLOE_UDUNITS PkgConfig::UDUNITS)
set(FLOE_JANSSON PkgConfig::JANSSON)
set(FLOE_CRYPTO PkgConfig::CRYPTO)
set(FLOE_HDF5 PkgConfig::HDF5)

# Debian's libhdf5.so brings 33 more libraries along (curl, for files on the web, and what curl needs), and to load them takes four
# fifths of the time in which floe starts. The archive of the same package needs two. (libfloe, which is shared, keeps libhdf5.so.)
set(FLOE_HDF5_ARCHIVE ${FLOE_HDF5})
find_library(FLOE_SZ_FILE NAMES sz NO_CACHE)
find_library(FLOE_Z_FILE NAMES z NO_CACHE)
if(FLOE_HDF5_FILE AND FLOE_SZ_FILE AND FLOE_Z_FILE)
    add_library(floe_hdf5_archive INTERFACE)
    target_include_directories(floe_hdf5_archive SYSTEM INTERFACE ${HDF5_INCLUDE_DIRS})
    target_link_libraries(floe_hdf5_archive INTERFACE ${FLOE_HDF5_FILE} ${FLOE_SZ_FILE} ${FLOE_Z_FILE} ${CMAKE_DL_LIBS})
    set(FLOE_HDF5_ARCHIVE floe_hdf5_archive)
endif()
set(FLOE_SUNDIALS SUNDIALS::nvecserial SUNDIALS::sunlinsoldense SUNDIALS::sunmatrixdense
    SUNDIALS::sunnonlinsolfixedpoint SUNDIALS::cvode)
