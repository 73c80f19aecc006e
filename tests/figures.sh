#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Figures about cases in README.md, docs/ and cases/: each stands in the text that its comment belongs to, and a wrong one
# is noticed; each command is begun, and stopped at once.  With BREECH_FULL=1 a sixth of them is run to its end and the
# figures compared, another sixth for every commit (all: validate/figures.py BREECH OUT, over two hours of two cores).
#   tests/figures.sh BREECH
set -euo pipefail
breech=$1 figures=$(dirname "$(realpath "$0")")/validate/figures.py python=/usr/bin/python3
[ -x $python ] || { echo "skipped: no $python" && exit 77; }
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

page() # the peak in the text, in the list
{
    printf '# A page\nOne unit: %s kA.\n\n<!-- figures: breech shot cases/pulse_unit_200kJ\n' "$1"
    printf -- '- {key: peak_current, value: %s kA, within: 0.5 kA}\n-->\n' "$2"
}
must_fail() # what should be said, how to look
{
    if $python "$figures" "$breech" "${2:-$out}" "$out/page.md" >"$out/said" 2>&1 || ! grep -q "$1" "$out/said"; then
        echo "a wrong figure is not noticed: $1" && cat "$out/said" && exit 1
    fi
}
page 169.2 169.2 >"$out/page.md"
$python "$figures" "$breech" "$out" "$out/page.md"
page 171.2 171.2 >"$out/page.md"
must_fail 'peak_current .* FAILS'
page 171.2 169.2 >"$out/page.md"
must_fail 'not in the text before it'
sed -i 's/pulse_unit_200kJ$/& --set bank.charge=9/' "$out/page.md"
must_fail 'bank.charge = 9: needs a unit' --try

$python "$figures" "$breech" --try
if [ "${BREECH_FULL:-0}" != 1 ]; then exit; fi
commit=$(git -C "$(dirname "$figures")" rev-parse --short=7 HEAD 2>/dev/null || echo 0)
$python "$figures" "$breech" figures-out --part $((16#$commit % 6))/6
