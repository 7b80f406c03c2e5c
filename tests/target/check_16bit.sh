#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The firmware's sources through a tool that knows 16-bit machines:
#
#   check_16bit.sh avr | msp430 | cppcheck
#
# avr and msp430: clang for a machine whose int has 16 bits, like the C28x; a double has 32 bits there
# (as in TI's COFF) or 64 (as in its EABI). cppcheck: the C28x itself, described in c28x.xml.
#
# First every defect in seeds/ must be found by what its comment names (clang: both passes; a double is
# no wider than a float for avr, so a promotion is msp430's alone); a tool that finds nothing any more
# would else look like clean sources.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
here=tests/target
stand_in=host_tools/sil/f28335/include # headers of the device, for firmware/board/f28335
tool=${1-}

mapfile -t includes < <(find firmware/{control,commission,store,config,app} -type d -printf '-I%p\n')
includes+=(-Ifirmware/board -Ifirmware/board/program -Ifirmware/board/f28335)
clang_flags=(-std=c99 -fsyntax-only -ffreestanding -nostdlibinc -isystem "$here/include"
    -Wall -Wextra -Wpedantic -Werror
    -Wconversion -Wsign-conversion -Wfloat-conversion -Wdouble-promotion -Wshorten-64-to-32
    -Wimplicit-int-conversion -Wimplicit-float-conversion -Wimplicit-int-float-conversion
    -Wshift-overflow -Wshift-count-overflow -Winteger-overflow -Wconstant-conversion
    -Wtautological-compare -Wtautological-constant-out-of-range-compare -Wcast-align -Wcast-qual
    -Wshadow -Wundef -Wfloat-equal -Wswitch-enum -Wstrict-prototypes -Wmissing-prototypes -Wvla
    -Wno-avr-rtlib-linking-quirks) # nothing is linked
cppcheck_flags=(--platform="$here/c28x.xml" --std=c99 --error-exitcode=1 --quiet --inline-suppr
    "--enable=warning,performance,portability" --template='{file}:{line}: {severity}: {message} [{id}]')

# analyse <extra options..> -- <files..>: the tool's report on stdout, its verdict as status
analyse()
{
    local options=()
    while [[ $1 != -- ]]; do
        options+=("$1")
        shift
    done
    shift
    case $tool in
        avr | msp430) clang --target="$tool" "${clang_flags[@]}" "${options[@]}" "$@" 2>&1 ;;
        cppcheck) cppcheck "${cppcheck_flags[@]}" "${options[@]}" "$@" 2>&1 ;;
    esac
}

# The seeded defects: each one that names the tool must be refused, for the reason it names.
self_test()
{
    local keys="clang|$tool" seed wanted report seeds=0
    [[ $tool != cppcheck ]] || keys=cppcheck
    for seed in "$here"/seeds/*.c; do
        wanted=$(sed -nE "s#^/\* ($keys): (.*) \*/\$#\2#p" "$seed")
        [[ -n $wanted ]] || continue
        seeds=$((seeds + 1))
        if report=$(analyse -- "$seed"); then
            printf '%s: %s accepts this defect\n' "$seed" "$tool"
            return 1
        fi
        if ! grep -qF -- "$wanted" <<<"$report"; then
            printf '%s: %s does not name %s:\n%s\n' "$seed" "$tool" "$wanted" "$report"
            return 1
        fi
    done
    ((seeds >= 4)) || { printf 'only %d seeded defects\n' "$seeds"; return 1; }
    printf '%s: all of %d seeded defects found\n' "$tool" "$seeds"
}

# check <folder> <extra options..>: all C files of one folder
check()
{
    local folder=$1
    shift
    local files
    mapfile -t files < <(find "$folder" -name '*.c' | sort)
    [[ -e ${files[0]-} ]] || { printf '%s: no C files\n' "$folder"; return 1; }
    analyse "$@" -- "${files[@]}" || return 1
    printf '%s: %s: %d files clean\n' "$tool" "$folder" "${#files[@]}"
}

case $tool in
    avr | msp430 | cppcheck) ;;
    *)
        printf 'usage: %s avr | msp430 | cppcheck\n' "$0" >&2
        exit 2
        ;;
esac

self_test
check firmware/control "${includes[@]}"
check firmware/one_unit "${includes[@]}"
check firmware/config "${includes[@]}"
check firmware/commission "${includes[@]}"
check firmware/app "${includes[@]}"
check firmware/store "${includes[@]}"
# The board waits with an instruction of the device, so it needs the stand-in's meaning of asm too.
device=("${includes[@]}" -isystem "$stand_in" -include "$stand_in/c28_cpu.h")
[[ $tool != cppcheck ]] || device=("${includes[@]}" -I"$stand_in" --suppress="*:$stand_in/*")
check firmware/board/program "${device[@]}"
check firmware/board/f28335 "${device[@]}"
