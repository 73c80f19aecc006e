# Case files, units and materials: sources of breech_coupling (included by coupling/CMakeLists.txt)
set(COUPLING_CASE_SOURCES io/case.c io/case_check.c io/case_errors.c io/case_read.c io/case_schema.c io/case_write.c
                          io/case_population.c io/file_text.c io/material_file.c io/profile_file.c io/treatment.c io/treatment_armature_metal.c
                          io/treatment_coating.c io/treatment_hardening.c io/treatment_lead_angle.c io/treatment_polish.c
                          io/treatment_preheat.c io/treatment_rail_metal.c io/units.c io/yaml_tree.c)
