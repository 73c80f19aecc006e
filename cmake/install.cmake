# SPDX-License-Identifier: BSD-3-Clause
# cmake --install and cpack.  An installation may be moved: the program finds cases and materials from its own place
# (coupling/case/material_places.c), breech-config.cmake and the .pc files what they name from theirs.
#   bin/breech
#   lib/libbreech_{base,circuit,mpm}.a, lib/cmake/breech, lib/pkgconfig, include/breech/{base,circuit,mpm}
#   lib/python3/dist-packages/breech
#   share/breech/{cases,tools}, share/doc/breech with the paths of the source tree, manual page, completion
include(CMakePackageConfigHelpers)

if(NOT TARGET breech)
    return()
endif()

install(TARGETS breech RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY cases DESTINATION ${CMAKE_INSTALL_DATADIR}/breech)
install(FILES coupling/tools/paraview_crater.py DESTINATION ${CMAKE_INSTALL_DATADIR}/breech/tools)
install(DIRECTORY python/breech DESTINATION lib/python3/dist-packages FILES_MATCHING PATTERN "*.py")

# ---- manual ----

# What the program says of its commands and options.
set(manual ${CMAKE_BINARY_DIR}/manual)
file(MAKE_DIRECTORY ${manual})
add_custom_command(OUTPUT ${manual}/breech.1 ${manual}/breech ${manual}/_breech
                   COMMAND breech --man > ${manual}/breech.1
                   COMMAND breech --completion bash > ${manual}/breech
                   COMMAND breech --completion zsh > ${manual}/_breech
                   DEPENDS breech VERBATIM)
add_custom_target(manual ALL DEPENDS ${manual}/breech.1 ${manual}/breech ${manual}/_breech)
install(FILES ${manual}/breech.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${manual}/breech DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES ${manual}/_breech DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
install(FILES LICENSE README.md CHANGELOG.md CITATION.cff CONTRIBUTING.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} PATTERN site EXCLUDE)
install(DIRECTORY ${CMAKE_BINARY_DIR}/docs/html DESTINATION ${CMAKE_INSTALL_DOCDIR} OPTIONAL) # where the target `docs` was built
install(DIRECTORY python/examples DESTINATION ${CMAKE_INSTALL_DOCDIR}/python)
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DOCDIR})
file(RELATIVE_PATH cases_from_doc /${CMAKE_INSTALL_DOCDIR} /${CMAKE_INSTALL_DATADIR}/breech/cases)
install(CODE "
    file(CREATE_LINK \"${cases_from_doc}\" \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DOCDIR}/cases\" SYMBOLIC)")

# ---- libraries: breech::base, breech::circuit, breech::mpm ----

# The public headers, and what they include.
set(headers base/constants.h base/param.h base/status.h)
if(TARGET breech_circuit)
    list(APPEND headers circuit/shot.h circuit/firing.h)
endif()
if(TARGET breech_mpm)
    list(APPEND headers mpm/mpm.h mpm/law/flow_curve.h)
endif()
set(public ${headers})
while(headers)
    list(POP_FRONT headers header)
    file(STRINGS ${header} lines REGEX "^#include \"")
    foreach(line ${lines})
        string(REGEX REPLACE "^#include \"([^\"]*)\".*" "\\1" included "${line}")
        if(NOT included IN_LIST public)
            list(APPEND public ${included})
            list(APPEND headers ${included})
        endif()
    endforeach()
endwhile()
set(BREECH_PUBLIC_HEADERS ${public})
foreach(header ${public})
    get_filename_component(folder ${header} DIRECTORY)
    install(FILES ${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/breech/${folder})
endforeach()

set(libraries "")
foreach(library base circuit mpm)
    if(TARGET breech_${library})
        list(APPEND libraries breech_${library})
    endif()
endforeach()
install(TARGETS ${libraries} EXPORT breech ARCHIVE DESTINATION lib)
install(EXPORT breech NAMESPACE breech:: FILE breech-targets.cmake DESTINATION lib/cmake/breech)
configure_package_config_file(packaging/breech-config.cmake.in ${CMAKE_BINARY_DIR}/packaging/breech-config.cmake
                              INSTALL_DESTINATION lib/cmake/breech)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/packaging/breech-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/packaging/breech-config.cmake ${CMAKE_BINARY_DIR}/packaging/breech-config-version.cmake
        DESTINATION lib/cmake/breech)

set(pc_sundials -lsundials_ida -lsundials_nvecserial -lsundials_sunmatrixdense -lsundials_sunlinsoldense)
if(TARGET SUNDIALS::core)
    list(APPEND pc_sundials -lsundials_core)
endif()
string(JOIN " " pc_sundials ${pc_sundials})
string(JOIN " " pc_openmp ${OpenMP_C_FLAGS})
set(pc_mvec "")
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    set(pc_mvec -lmvec)
endif()
foreach(library base circuit mpm)
    if(TARGET breech_${library})
        configure_file(packaging/breech-${library}.pc.in ${CMAKE_BINARY_DIR}/packaging/breech-${library}.pc @ONLY)
        install(FILES ${CMAKE_BINARY_DIR}/packaging/breech-${library}.pc DESTINATION lib/pkgconfig)
    endif()
endforeach()

# ---- the Debian package: cpack in the build folder ----

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME breech)
set(CPACK_PACKAGE_CONTACT "The Breech authors <breech@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3-h5py, python3-numpy")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "python3-matplotlib, paraview, libsundials-dev, libgsl-dev")
include(CPack)
