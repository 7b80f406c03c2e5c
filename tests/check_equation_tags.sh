#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Every equation tag in the code is one row of docs/equations.md, and every row is in the code. Every test
# of a row is registered in tests/CMakeLists.txt.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

used=$(grep -rhoE 'EQ-[A-Z]+(-[A-Z]+)*-[0-9]+' firmware host_tools | sort -u)
rows=$(grep -oE '^\| EQ-[A-Z]+(-[A-Z]+)*-[0-9]+' docs/equations.md | cut -c3- | sort)
status=0

complain()
{
    [[ -z $2 ]] && return
    printf '%s:\n%s\n' "$1" "$2" >&2
    status=1
}

complain "defined twice in docs/equations.md" "$(uniq -d <<<"$rows")"
complain "in the code but not in docs/equations.md" "$(comm -23 <(echo "$used") <(sort -u <<<"$rows"))"
complain "in docs/equations.md but not in the code" "$(comm -13 <(echo "$used") <(sort -u <<<"$rows"))"

while read -r test; do
    pattern="sdre_unit_test(${test#unit.})"
    [[ $test != unit.app* ]] || pattern="sdre_app_test(${test#unit.})"
    [[ $test == unit.* ]] || pattern="sdre_host_test(${test/./ })"
    [[ $test != f28335.* ]] || pattern="sdre_f28335_test(${test#f28335.} "
    grep -qF "$pattern" tests/CMakeLists.txt tests/f28335/CMakeLists.txt || complain "not a registered test" "$test"
done < <(awk -F' *[|] *' '/^\| EQ-/ {print $(NF-2)}' docs/equations.md | sort -u)
exit "$status"
