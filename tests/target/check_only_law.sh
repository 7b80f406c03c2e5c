#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What DRIVE_ONLY_LAW leaves out, seen by nm: check_only_law.sh C_COMPILER. No function of another law may be wanted by
# the period or by the check of the constants; without the definition all of them are.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# wanted <law or nothing>: the functions of other files that the period and the check refer to
wanted()
{
    local file options=(-std=c99 -O2 -c -Ifirmware/control)
    [[ -z $1 ]] || options+=("-DDRIVE_ONLY_LAW=$1")
    for file in drive_tick estimate drive_config; do
        "$cc" "${options[@]}" "firmware/control/$file.c" -o "$work/$file.o"
        nm --undefined-only "$work/$file.o" | awk '{print $2}'
    done | sort -u
}

# expect <law or nothing> <yes or no> <pattern>
expect()
{
    local found=no
    grep -qE "^($3)" <<<"$(wanted "$1")" && found=yes
    if [[ $found != "$2" ]]; then
        printf 'DRIVE_ONLY_LAW=%s: %s wanted: %s, expected %s\n' "$1" "$3" "$found" "$2"
        status=1
    fi
}

cc=$1
status=0
of_near_optimal='current_ref_update|speed_ref_update|nosc_limit_speed_error|feedforward_V'
of_noc='nodo_encoder_correct|nodo_update'
of_noc_h='nodo_harmonic_'
of_conventional='conventional_'
of_servo='servo_law_|dobc_|pid_law_'

# expect_all <law or nothing> <one answer for each of the five>
expect_all()
{
    local law=$1 answers=("${@:2}") n=0 pattern
    for pattern in "$of_near_optimal" "$of_noc" "$of_noc_h" "$of_conventional" "$of_servo"; do
        expect "$law" "${answers[n]}" "$pattern"
        n=$((n + 1))
    done
}

expect_all '' yes yes yes yes yes
expect_all DRIVE_LAW_NOC yes yes no no no
expect_all DRIVE_LAW_NOC_H yes no yes no no
expect_all DRIVE_LAW_CONVENTIONAL yes no no yes no
expect_all DRIVE_LAW_SERVO no no no no yes
exit "$status"
