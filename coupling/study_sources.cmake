# Hand-off and study (included by coupling/CMakeLists.txt)
set(COUPLING_STUDY_SOURCES handoff/scene_from_state.c handoff/scene_run.c handoff/screen.c handoff/site_state.c
                           study/commands.c study/onset.c study/scene_key.c study/scenes.c study/session.c study/store.c
                           study/threshold.c)
