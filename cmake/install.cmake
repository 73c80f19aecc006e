# SPDX-License-Identifier: BSD-3-Clause
# cmake --install: program, libraries, headers (use -I<prefix>/include/breech), cases with their materials.
foreach(target breech breech_base breech_circuit breech_mpm breech_coupling)
    if(TARGET ${target})
        install(TARGETS ${target}
                RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR}
                ARCHIVE DESTINATION lib)
    endif()
endforeach()
install(DIRECTORY base circuit mpm coupling
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/breech
        FILES_MATCHING PATTERN "*.h" PATTERN "*.def")
install(DIRECTORY cases DESTINATION ${CMAKE_INSTALL_DATADIR}/breech)
install(FILES coupling/tools/paraview_crater.py DESTINATION ${CMAKE_INSTALL_DATADIR}/breech/tools)
install(DIRECTORY python/breech DESTINATION lib/python3/dist-packages FILES_MATCHING PATTERN "*.py")
install(FILES LICENSE README.md CHANGELOG.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR})
