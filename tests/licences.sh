#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Every source file says its licence in its first three lines, as SPDX has it.    tests/licences.sh [--write]
# --write: adds the line where it is missing.
set -euo pipefail
cd "$(dirname "$0")/.."
source tests/files.sh
line='SPDX-License-Identifier: BSD-3-Clause'
pattern='(\.(c|h|def|inc|py|sh|cmake|cmake\.in|toml|yml|clang-format)|(^|/)(CMakeLists\.txt|Containerfile))$'
mapfile -t missing < <(sources "$pattern" | xargs awk -v line="$line" '
    FNR == 1 { if (file != "" && !says) print file; file = FILENAME; says = 0 }
    FNR <= 3 && index($0, line) { says = 1 }
    FNR > 3 { nextfile }
    END { if (!says) print file }')
if [ "${1:-}" = --write ]; then
    for file in "${missing[@]}"; do
        case $file in
        *.c | *.h | *.def | *.inc) sed -i "1i /* $line */" "$file" ;;
        *) if head -n 1 "$file" | grep -q '^#!'; then sed -i "1a # $line" "$file"; else sed -i "1i # $line" "$file"; fi ;;
        esac
    done
    exit
fi
looked=$(sources "$pattern" | wc -l)
if [ ${#missing[@]} != 0 ]; then
    printf 'no line "%s" (tests/licences.sh --write adds it):\n' "$line"
    printf '%s\n' "${missing[@]}"
    exit 1
fi
[ "$looked" -gt 400 ] || { echo "only $looked files were looked at" && exit 1; }
echo "$looked files say their licence"
