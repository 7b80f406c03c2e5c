#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# cppcheck's MISRA C:2012 addon against docs/deviations.md: no rule that is not in its table, no more findings than it
# allows, no row without a finding.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

mapfile -t includes < <(find firmware/{control,commission,store,config,app} -type d -printf '-I%p\n')
includes+=(-Ifirmware/board -Ifirmware/board/program -Ifirmware/board/f28335)
findings=$(cppcheck --addon=misra --std=c99 --platform=tests/target/c28x.xml --quiet --inline-suppr \
    --template='{file}:{line} {id}' "${includes[@]}" firmware/{control,app,store,commission} firmware/config/gain_tables.c 2>&1)
others=$(grep -v ' misra-c2012-' <<<"$findings" || true)
[[ -z $others ]] || {
    printf '%s\n' "$others"
    exit 1
}
allowed=$(sed -nE 's/^\| ([0-9]+\.[0-9]+) \| ([0-9]+) \|.*/\1 \2/p' docs/deviations.md | sort)
found=$(sed -E 's/.* misra-c2012-//' <<<"$findings" | sort | uniq -c | awk '{print $2, $1}' | sort)
status=0
while read -r rule most count; do
    if [[ $most == - || $count == - ]] || ((count > most)); then
        printf 'rule %s: docs/deviations.md allows %s, found %s\n' "$rule" "$most" "$count"
        grep " misra-c2012-${rule/./\\.}\$" <<<"$findings" || true
        status=1
    fi
done < <(join -a 1 -a 2 -e - -o 0,1.2,2.2 <(printf '%s\n' "$allowed") <(printf '%s\n' "$found"))
((status != 0)) || printf '%s rules deviate, as docs/deviations.md says\n' "$(wc -l <<<"$allowed")"
exit "$status"
