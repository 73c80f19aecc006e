# SPDX-License-Identifier: BSD-3-Clause
# Everything outside this repository, each as one imported target that a folder just links:
#   breech_sundials  GSL::gsl  breech_hdf5  breech_yaml  breech_udunits2  breech_cjson  breech_cmocka  OpenMP::OpenMP_C
#   MPI::MPI_C (only where MPI was found)
# The Debian packages that hold them are listed in cmake/debian-packages.sh.

function(breech_interface name)
    add_library(${name} INTERFACE IMPORTED GLOBAL)
    target_link_libraries(${name} INTERFACE ${ARGN})
endfunction()

# A library that has neither a CMake nor a dependable pkg-config file: header + library.
function(breech_plain name header library package)
    find_path(${name}_include ${header} PATH_SUFFIXES ${ARGN} REQUIRED)
    find_library(${name}_library ${library} REQUIRED)
    add_library(${name} INTERFACE IMPORTED GLOBAL)
    target_include_directories(${name} SYSTEM INTERFACE ${${name}_include})
    target_link_libraries(${name} INTERFACE ${${name}_library})
    mark_as_advanced(${name}_include ${name}_library)
endfunction()

# Its own version file refuses a range that 6.4.1 satisfies, so the version is compared here.
find_package(SUNDIALS REQUIRED COMPONENTS ida nvecserial sunmatrixdense sunlinsoldense)
if(SUNDIALS_VERSION VERSION_LESS 6.4 OR SUNDIALS_VERSION VERSION_GREATER_EQUAL 8)
    message(FATAL_ERROR "SUNDIALS ${SUNDIALS_VERSION} found; 6.4 to 7.x is needed (Debian: libsundials-dev)")
endif()
breech_interface(breech_sundials SUNDIALS::ida SUNDIALS::nvecserial SUNDIALS::sunmatrixdense SUNDIALS::sunlinsoldense)
if(TARGET SUNDIALS::core) # since 7
    target_link_libraries(breech_sundials INTERFACE SUNDIALS::core)
endif()

find_package(GSL REQUIRED)
find_package(OpenMP REQUIRED COMPONENTS C)
find_package(Threads REQUIRED)

# Serial even where the OpenMPI flavour is installed beside it (pkg-config hdf5 would give that one).
set(HDF5_PREFER_PARALLEL OFF)
find_package(HDF5 REQUIRED COMPONENTS C)
if(HDF5_IS_PARALLEL)
    message(FATAL_ERROR "the serial HDF5 is needed, a parallel one was found (Debian: libhdf5-dev)")
endif()
breech_interface(breech_hdf5 hdf5::hdf5)

breech_plain(breech_yaml yaml.h yaml libyaml-dev)
breech_plain(breech_udunits2 udunits2.h udunits2 libudunits2-dev udunits2)
breech_plain(breech_cjson cJSON.h cjson libcjson-dev cjson)
breech_plain(breech_cmocka cmocka.h cmocka libcmocka-dev)

if(BREECH_MPI)
    find_package(MPI QUIET COMPONENTS C)
endif()
