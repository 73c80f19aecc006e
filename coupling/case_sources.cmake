# Case files, units and materials: sources of breech_coupling (included by coupling/CMakeLists.txt)
set(COUPLING_CASE_SOURCES io/yaml_tree.c io/units.c io/case.c io/case_read.c io/case_schema.c io/case_errors.c
                          io/material_file.c)
