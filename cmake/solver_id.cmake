# SPDX-License-Identifier: BSD-3-Clause
# Writes OUT, a header with an id of all that turns a scene's inputs into its outcome: the solver's sources (SOURCES, a list
# of files), the compiler and its flags (TOOLCHAIN).  The scene store is keyed by it: results of another solver are not taken.
#   cmake -DOUT=... -DSOURCES=... -DTOOLCHAIN=... -P cmake/solver_id.cmake
set(all "${TOOLCHAIN}")
foreach(file ${SOURCES})
    file(SHA256 ${file} hash)
    string(APPEND all "\n${hash}")
endforeach()
string(SHA256 id "${all}")
string(SUBSTRING ${id} 0 16 id)
set(text "#define BREECH_SOLVER_ID \"${id}\"\n")
if(EXISTS ${OUT})
    file(READ ${OUT} old)
endif()
if(NOT "${old}" STREQUAL "${text}")
    file(WRITE ${OUT} "${text}")
endif()
