# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=bash
# Sourced: sources REGEX lists the files of this repository whose path matches, one a line: tracked, and new ones that
# git does not ignore.  Works without git too.
sources()
{
    local file
    if git rev-parse --is-inside-work-tree >/dev/null 2>&1 && [ -z "$(git rev-parse --show-prefix)" ]; then
        git ls-files --cached --others --exclude-standard
    else
        find . -type f -not -path './build*' -not -path './out/*' -not -path './.git/*' -printf '%P\n' | sort
    fi | grep -E "$1" | while read -r file; do
        if [ -f "$file" ]; then printf '%s\n' "$file"; fi
    done
}
