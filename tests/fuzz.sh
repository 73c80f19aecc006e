#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Fuzzes every target of tests/fuzz with N inputs each (1 000 000 unless told), starting from the seeds in
# tests/fuzz/seeds/<target>.  A crash leaves its input in build/fuzz/.
set -euo pipefail
cd "$(dirname "$0")/.."
inputs=${1:-1000000}

cmake --preset fuzz
cmake --build --preset fuzz --parallel "$(nproc)"
shopt -s nullglob
targets=(build/fuzz/bin/fuzz_*)
if [ ${#targets[@]} = 0 ]; then echo 'no fuzz target was built' && exit 1; fi
for target in "${targets[@]}"; do
    name=$(basename "$target")
    corpus=build/fuzz/corpus/$name
    mkdir -p "$corpus"
    seeds=(tests/fuzz/seeds/"$name")
    words=(tests/fuzz/"$name".dict) # none for some targets
    "$target" -runs="$inputs" -max_len=8192 -timeout=10 -print_final_stats=1 -artifact_prefix=build/fuzz/ \
        "${words[@]/#/-dict=}" "$corpus" "${seeds[@]}"
done
