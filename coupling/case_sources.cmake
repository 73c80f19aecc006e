# Case files, units and materials: sources of breech_coupling (included by coupling/CMakeLists.txt)
set(COUPLING_CASE_SOURCES io/case.c io/case_check.c io/case_errors.c io/case_read.c io/case_schema.c io/case_write.c
                          io/file_text.c io/material_file.c io/profile_file.c io/units.c io/yaml_tree.c)
