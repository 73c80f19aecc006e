#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The arrows of the design hold, and nothing else is included:
#   tests -> coupling -> {circuit, mpm} -> base
#   in coupling:  main -> usage -> study -> {gouge, strike, life, vessel} -> run -> scene -> {case, output, report} -> host
# circuit and mpm print nothing, open nothing and never exit; each outside library sits behind one file; every folder
# is in docs/reference/structure.md.
set -euo pipefail
cd "$(dirname "$0")/.."
source tests/files.sh

bad=0
complain()
{
    printf '%s\n' "$@"
    bad=1
}

# folder, what it may include with quotes
arrow()
{
    local hits
    hits=$(sources "^$1/.*\.(c|h|def)$" | xargs -r grep -nE '^[[:space:]]*#[[:space:]]*include[[:space:]]*"' /dev/null |
        grep -vE "include[[:space:]]*\"($2)/" || true)
    if [ -n "$hits" ]; then complain "$1/ may include only $2 (written from the root):" "$hits"; fi
}

# room of coupling, the rooms of coupling that it may include beside itself
rooms=''
room()
{
    rooms+=" $1"
    arrow "coupling/$1" "coupling/($1|${2:-$1})|$(if [ "$1" = host ]; then echo base; else echo 'circuit|mpm|base'; fi)"
}

# folder, regex of functions that must not be called; comments are taken out of what names one
silent()
{
    local file hits
    while read -r file; do
        hits=$(cc -fpreprocessed -dD -E -w -P -x c "$file" 2>/dev/null | sed -E 's/"([^"\\]|\\.)*"/""/g' |
            grep -E "(^|[^A-Za-z0-9_])($2)[[:space:]]*\(" || true)
        if [ -n "$hits" ]; then complain "$file: a library neither prints, opens files nor exits:" "$hits"; fi
    done < <(sources "^$1/.*\.[ch]$" | xargs -r grep -lE "(^|[^A-Za-z0-9_])($2)[[:space:]]*\(" /dev/null || true)
}

# header: number of files that include it
users()
{
    sources '\.[ch]$' | xargs -r grep -lE "#[[:space:]]*include[[:space:]]*\"$1\"" /dev/null | wc -l
}

# library, regex of its headers, folder in which one file may include them; a header of ours that only one file
# includes (two versions of a library made alike) counts as part of that file
behind()
{
    local files file n=0
    files=$(sources '\.[ch]$' | grep -v '^tests/' | xargs -r grep -lE "#[[:space:]]*include[[:space:]]*<($2)" /dev/null || true)
    for file in $files; do
        if [[ $file != "$3"/* ]]; then complain "$1 belongs to $3/: $file"; fi
        if [[ $file != *.h ]] || [ "$(users "$file")" != 1 ]; then n=$((n + 1)); fi
    done
    if [ $n -gt 1 ]; then complain "$1 must sit behind one file, it is included in:" "$files"; fi
}

# library, regex of its headers, folders in which it may be used
only_in()
{
    local files
    files=$(sources '\.[ch]$' | grep -vE "^(tests|$3)/" | xargs -r grep -lE "#[[:space:]]*include[[:space:]]*<($2)" /dev/null || true)
    if [ -n "$files" ]; then complain "$1 may be used in $3 alone:" "$files"; fi
}

arrow base base
arrow circuit 'circuit|base'
arrow mpm 'mpm|base'
arrow coupling 'coupling|circuit|mpm|base'

room host
room case host
room output host
room report 'output|host'
room scene 'case|output|host'
room run 'scene|case|output|host'
for what in gouge strike life vessel; do room $what 'run|scene|case|output|host'; done
room study 'gouge|strike|life|vessel|run|scene|case|output|report|host'
room usage 'study|gouge|strike|life|vessel|run|scene|case|output|report|host'
for folder in coupling/*/; do
    folder=$(basename "$folder")
    if [[ " $rooms tools " != *" $folder "* ]]; then complain "coupling/$folder/ is no room of this script"; fi
done

# Every folder of the libraries and the program stands in the table of docs/reference/structure.md, with its path or,
# in the row of the folder it is in, with its name.
while read -r folder; do
    if ! grep -qE "^\|.*\`($folder|${folder##*/})/\`" docs/reference/structure.md; then
        complain "$folder/ has no row in docs/reference/structure.md"
    fi
done < <(sources '^(base|circuit|mpm|coupling)/.*/|^(base|circuit|mpm)/' | sed 's|/[^/]*$||' | sort -u)

# The file's struct stays in coupling/case; the others get the plain structs that it makes (case_plain.h).
hits=$(sources '^coupling/.*\.(c|h|def)$' | grep -v '^coupling/case/' | xargs -r grep -nwE 'breech_case|case/case\.h' /dev/null || true)
if [ -n "$hits" ]; then complain 'breech_case and case.h belong to coupling/case/:' "$hits"; fi

calls='v?f?printf|puts|fputs|putchar|putc|fputc|fwrite|perror|fopen|freopen|open|exit|_exit|quick_exit|abort|system|popen'
silent circuit "$calls"
silent mpm "$calls"

behind SUNDIALS '(sundials|ida|idas|cvode|nvector|sunmatrix|sunlinsol|sunnonlinsol)/' circuit
behind HDF5 'hdf5' coupling
behind libyaml 'yaml\.h' coupling
behind udunits2 'udunits2' coupling
only_in GSL 'gsl/' 'circuit|coupling'
only_in OpenMP 'omp\.h' 'mpm|coupling'
only_in MPI 'mpi\.h' coupling

[ $bad = 0 ] && echo 'the arrows hold'
exit $bad
