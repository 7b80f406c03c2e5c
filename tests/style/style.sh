#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# style.sh DIRECTORY: the style of all C, C++ and Python files that git knows, with the tools in DIRECTORY. The last check
# shows that each of the others finds a defect.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
tools=$1
status=0

# check NAME COMMAND..
check()
{
    printf '== %s\n' "$1"
    "${@:2}" || {
        printf 'style: %s: FAILED\n' "$1" >&2
        status=1
    }
}

# Without its count of warnings in system headers. The board's files see the registers of the virtual device.
tidy()
{
    "$tools/clang-tidy" --quiet --config-file=tests/style/clang-tidy.yml "${core[@]}" "${board[@]}" -- -std=c99 -Ifirmware/board -Ifirmware/board/program \
        -Ifirmware/board/f28335 -isystem host_tools/sil/f28335/include -include host_tools/sil/f28335/f28335_names.h \
        -isystem "$(gcc -print-file-name=include)" "${includes[@]}" \
        2> >(grep -Ev '^[0-9]+ warnings? generated\.$' >&2)
}

mapfile -t c_like < <(git ls-files '*.c' '*.h' '*.cpp' '*.hpp')
# The generated map has rows alike.
mapfile -t core < <(git ls-files firmware/{control,commission,store,app,one_unit}'/*.c' | grep -vxE 'firmware/app/(registers/app_registers|canopen/app_canopen)_map\.c')
mapfile -t board < <(git ls-files 'firmware/board/f28335/*.c' 'firmware/board/program/*.c')
mapfile -t includes < <(find firmware/{control,commission,store,config,app} -type d -printf '-I%p\n')

check "ruff check" "$tools/ruff" check --no-cache --quiet .
check "ruff format" "$tools/ruff" format --no-cache --quiet --diff .
check mypy "$tools/mypy" --config-file host_tools/python/pyproject.toml --cache-dir build/style/mypy --no-error-summary \
    host_tools/python/{sdre,sdre_campaign,sdre_drive,sdre_tools}
check clang-format "$tools/clang-format" --dry-run -Werror "${c_like[@]}"
check clang-tidy tidy
check "seeded defects" "$tools/python" -B tests/style/test_seeds.py --quiet
exit "$status"
