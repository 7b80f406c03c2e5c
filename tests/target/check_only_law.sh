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
    for file in drive_tick drive_config; do
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
of_noc='nosc_|current_ref_|speed_ref_|nodo_encoder_correct|nodo_encoder_predict|nodo_update|feedforward_V'
of_servo='servo_law_|dobc_|pid_law_'
for law in '' DRIVE_LAW_NOC; do
    expect "$law" yes "$of_noc"
done
for law in '' DRIVE_LAW_SERVO; do
    expect "$law" yes "$of_servo"
done
expect DRIVE_LAW_SERVO no "$of_noc"
expect DRIVE_LAW_NOC no "$of_servo"
exit "$status"
