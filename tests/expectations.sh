#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# What the shipped cases expect of themselves, as a user runs them:   tests/expectations.sh PROGRAM
# The quick ones; with BREECH_FULL=1 every list of expectations.  A list's first line says the command, "# Of `breech
# life`."; those of cases/verification are of `breech scene`.
set -euo pipefail
breech=$1
cd "$(dirname "$0")/.."
v=cases/verification
quick="$v/copper_hugoniot $v/two_disks $v/spinning_strut $v/bending_strut $v/sod $v/notched_bar cases/rail_life
    cases/rail_life/treatments.yaml cases/rail_fatigue cases/gel_droplet cases/gel_droplet/sphere.yaml
    cases/gel_droplet/three.yaml"
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

# The case of a list: its folder, or NAME.yaml for NAME_expected.yaml.
case_of()
{
    local name=${1##*/}
    name=${name%expected.yaml}
    if [ -z "$name" ]; then dirname "$1"; else printf '%s/%s.yaml\n' "$(dirname "$1")" "${name%_}"; fi
}

bad=0 run=
for list in cases/*/*expected.yaml "$v"/*/*expected.yaml; do
    case=$(case_of "$list")
    [ "${BREECH_FULL:-0}" = 1 ] || [[ " $(echo $quick) " == *" $case "* ]] || continue
    run+=" $case"
    command=$(sed -nE '1s/^# Of `breech ([a-z]+)`.*/\1/p' "$list")
    if [[ $case == "$v"/* ]]; then command=scene; fi
    [ -n "$command" ] || { echo "$list: its first line does not say of which command it is" && exit 1; }
    printf '%s %s\n' "$command" "$case"
    "$breech" "$command" "$case" -o "$out/run" --force --quiet --set output.report=no --set output.snapshots=0 \
        2>"$out/said" || { cat "$out/said" && exit 1; }
    "$breech" check "$case" --expect "$out/run" || bad=1
done
for case in $quick; do
    [[ "$run " == *" $case "* ]] || { echo "$case: was to be run, and has no list of expectations" && bad=1; }
done
exit $bad
