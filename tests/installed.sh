# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=bash
# An installation works, with nothing of the environment:   tests/installed.sh PREFIX EMPTY_FOLDER VERSION
# Called by tests/install.sh and tests/deb.sh; needs neither the tree nor the build.
set -euo pipefail
prefix=$(realpath "$1") folder=$2 version=$3
cd "$folder"
fail()
{
    printf '%s\n' "$*" >&2
    exit 1
}
breech() { env -i PATH=/usr/bin:/bin ASAN_OPTIONS="${ASAN_OPTIONS:-}" "$prefix/bin/breech" "$@"; }

for file in bin/breech share/breech/cases/materials share/breech/tools/paraview_crater.py share/man/man1/breech.1 \
    share/bash-completion/completions/breech share/zsh/vendor-completions/_breech lib/python3/dist-packages/breech/__init__.py \
    include/breech/base/status.h include/breech/circuit/shot.h include/breech/mpm/mpm.h lib/libbreech_mpm.a \
    lib/pkgconfig/breech-mpm.pc lib/cmake/breech/breech-config.cmake share/doc/breech/README.md share/doc/breech/docs/README.md; do
    [ -e "$prefix/$file" ] || fail "not installed: $file"
done
if [ -e "$prefix/include/breech/coupling" ]; then fail 'the program'"'"'s own headers are installed'; fi

[[ $(breech --version) == "breech $version,"* ]] || fail "breech --version does not say $version"
breech --man | cmp - "$prefix/share/man/man1/breech.1" || fail 'the manual page is not that of the program'
breech --completion bash | cmp - "$prefix/share/bash-completion/completions/breech" || fail 'the completion is not that of the program'
materials=$(breech materials) || fail 'breech materials fails on the installed materials'
for file in "$prefix"/share/breech/cases/materials/*.yaml; do
    grep -q "$(basename "$file" .yaml)\b" <<<"$materials" || fail "breech materials does not list $file"
done
grep -qF "$prefix/share/breech/cases/materials" <<<"$materials" || fail "breech materials lists those of another place: $materials"

# A shipped case by its name, by the path of README.md, and as a base; a case of that name that is here comes first.
breech shot cases/default_shot -o path --quiet --set output.report=no || fail 'breech shot cases/default_shot'
printf 'base: default_shot\nname: own\noutput: {report: no}\nbank: {charge: 9 kV}\n' >own.yaml
breech shot own.yaml -o own --quiet || fail 'a case on a shipped one'
grep -q 'charge: 9000 V' own/used.yaml && grep -q 'copper' own/used.yaml || fail 'the case on a shipped one is another'
mkdir default_shot && cp own.yaml default_shot/case.yaml && sed -i 's/9 kV/8 kV/; s/default_shot/cases\/default_shot/' default_shot/case.yaml
breech check default_shot | grep -q '^default_shot/case.yaml' || fail 'a shipped case hides one that is here'
if breech check cases/../default_shot/nothing 2>err || breech check nothing_like_it 2>err; then fail 'a case that is nowhere is found'; fi
grep -q 'nothing_like_it' err || fail "$(cat err)"

# Every link of the manual that is no address leads to a file of the installation; of the sources only pages, cases, Python.
bad=0
while IFS=: read -r page link; do
    target=$(dirname "$page")/${link%%#*}
    if [ -n "${link%%#*}" ] && [ ! -e "$target" ]; then echo "$page: $link leads nowhere" && bad=1; fi
done < <(cd "$prefix/share/doc/breech" && grep -roE --include='*.md' '\]\([^)#][^)]*\)' "$PWD" | sed -E 's/\]\(//; s/\)$//' | grep -v ':https\?://')
[ $bad = 0 ] || exit 1

if python3=$(command -v /usr/bin/python3) && $python3 -c 'import numpy, h5py' 2>/dev/null; then
    said=$(env -i PATH=/usr/bin:/bin ASAN_OPTIONS="${ASAN_OPTIONS:-}" PYTHONPATH="$prefix/lib/python3/dist-packages" PYTHONDONTWRITEBYTECODE=1 $python3 -c '
import breech
print(breech.program(), breech.run("shot", "own.yaml", "py", progress=False).summary["status"])')
    [ "$said" = "$prefix/bin/breech done" ] || fail "the Python package says: $said"
fi
echo "installed and used in $prefix"
