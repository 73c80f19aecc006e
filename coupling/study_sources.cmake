# Hand-off and study (included by coupling/CMakeLists.txt)
set(COUPLING_STUDY_SOURCES handoff/scene_from_state.c handoff/scene_run.c handoff/scene_shelf.c handoff/screen.c handoff/site_state.c
                           study/commands.c study/compare.c study/crew.c study/crew_member.c study/family.c study/family_search.c
                           study/feedback.c study/gouge_law.c study/lending.c study/montecarlo.c study/onset.c study/population.c
                           study/repeated.c study/scene_key.c study/scene_work.c study/scenes.c study/sensitivity.c study/session.c study/store.c
                           study/surface.c study/threshold.c study/uncertain.c)
# Processes under mpirun.
if(MPI_C_FOUND)
    list(APPEND COUPLING_STUDY_SOURCES study/ranks_mpi.c)
    list(APPEND COUPLING_STUDY_LIBRARIES MPI::MPI_C)
else()
    list(APPEND COUPLING_STUDY_SOURCES study/ranks_alone.c)
endif()
