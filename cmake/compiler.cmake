# SPDX-License-Identifier: BSD-3-Clause
# Language and warnings of every folder.
set(CMAKE_C_STANDARD 11)
set(CMAKE_C_STANDARD_REQUIRED ON)
set(CMAKE_C_EXTENSIONS ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)

# No -march here: one binary runs everywhere, the mpm kernels choose their instruction set at run time.
add_compile_options(-Wall -Wextra -Wshadow -Wstrict-prototypes -Wmissing-prototypes)
if(BREECH_WERROR)
    add_compile_options(-Werror)
endif()

add_compile_definitions(BREECH_INSIDE) # names without a prefix, base/status.h

# Headers are included from the root: #include "base/status.h"
include_directories(${CMAKE_SOURCE_DIR})

if(BREECH_FUZZ)
    if(NOT CMAKE_C_COMPILER_ID STREQUAL "Clang")
        message(FATAL_ERROR "BREECH_FUZZ needs clang (libFuzzer): cmake --preset fuzz")
    endif()
    add_compile_options(-fsanitize=fuzzer-no-link)
endif()
