#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# What the shipped cases expect of themselves, as a user runs them:   tests/expectations.sh PROGRAM
# The quick ones; with BREECH_FULL=1 every list of expectations.  A list's first line says the command, "# Of `breech
# life`."; those of cases/verification are of `breech scene`.  Where a list's first line says "# At every shift along y.",
# the case is run with the grid shifted along y by each of `shifts`, and all are compared with the list.
set -euo pipefail
breech=$1
cd "$(dirname "$0")/.."
v=cases/verification
quick="$v/copper_hugoniot $v/two_disks $v/spinning_strut $v/bending_strut $v/sod $v/notched_bar cases/rail_life
    cases/rail_life/treatments.yaml cases/rail_fatigue cases/gel_droplet cases/gel_droplet/sphere.yaml
    cases/gel_droplet/three.yaml $v/pressed_blocks $v/pressed_blocks/metals.yaml $v/pressed_blocks/film.yaml
    $v/pressed_blocks/sliding.yaml $v/first_contact $v/first_contact/mirror.yaml $v/first_contact/plates.yaml
    $v/first_contact/water_on_water.yaml $v/rolling"
shifts="0 0.1 0.25 0.5 0.75 0.9" # of a cell
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

# The case of a list: its folder, or NAME.yaml for NAME_expected.yaml.
case_of()
{
    local name=${1##*/}
    name=${name%expected.yaml}
    if [ -z "$name" ]; then dirname "$1"; else printf '%s/%s.yaml\n' "$(dirname "$1")" "${name%_}"; fi
}

# What --set takes for a list, one a line: the grid's shifts, or what changes nothing.
settings_of()
{
    local axis shift
    axis=$(sed -nE '1s/^# At every shift along ([xyz])\..*/\1/p' "$1")
    for shift in $shifts; do
        case $axis in
            x) echo "scene.grid_shift=$shift 0 0" ;;
            y) echo "scene.grid_shift=0 $shift 0" ;;
            z) echo "scene.grid_shift=0 0 $shift" ;;
            *) echo output.report=no && break ;;
        esac
    done
}

bad=0 run=
for list in cases/*/*expected.yaml "$v"/*/*expected.yaml; do
    case=$(case_of "$list")
    [ "${BREECH_FULL:-0}" = 1 ] || [[ " $(echo $quick) " == *" $case "* ]] || continue
    run+=" $case"
    command=$(sed -nE '1s/^# Of `breech ([a-z]+)`.*/\1/p' "$list")
    if [[ $case == "$v"/* ]]; then command=scene; fi
    [ -n "$command" ] || { echo "$list: its first line does not say of which command it is" && exit 1; }
    while read -r setting; do
        printf '%s %s %s\n' "$command" "$case" "$setting"
        "$breech" "$command" "$case" -o "$out/run" --force --quiet --set output.report=no --set output.snapshots=0 \
            --set "$setting" 2>"$out/said" </dev/null || { cat "$out/said" && exit 1; }
        "$breech" check "$case" --expect "$out/run" || bad=1
    done < <(settings_of "$list")
done
for case in $quick; do
    [[ "$run " == *" $case "* ]] || { echo "$case: was to be run, and has no list of expectations" && bad=1; }
done
exit $bad
