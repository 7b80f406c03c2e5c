#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What the linker leaves out, seen by nm: check_linked_law.sh C_COMPILER. A program with the period and tables that name
# one law gets nothing of the other laws' files, by the plain rules of a static library.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cc=$1
status=0

root=$PWD
mapfile -t includes < <(find "$root/firmware/control" -type d -printf '-I%p\n')
(cd "$work" && "$cc" -std=c99 -c "${includes[@]}" $(find "$root/firmware/control" -name '*.c'))
ar rc "$work/libcontrol_core.a" "$work"/*.o
# Every external symbol with the object that defines it
for object in "$work"/*.o; do
    nm --defined-only --extern-only "$object" | awk -v name="$(basename "$object" .o)" '{print $3, name}'
done | sort >"$work/owners"

# The objects of the library that a program with this law contains
linked()
{
    cat >"$work/program.c" <<END
#include "drive_tick.h"
static const law_$1_config_t constants;
static const drive_config_t  config = {.law = &law_$1, .constants = &constants};
int main(void)
{
    static drive_t        drive;
    const drive_sample_t  sample  = {.valid = false};
    const drive_command_t command = {.run = false};
    (void)drive_init(&drive, &config);
    return drive_tick(&drive, &sample, &command).gate_enable ? 1 : 0;
}
END
    "$cc" -std=c99 "${includes[@]}" "$work/program.c" "$work/libcontrol_core.a" -lm -o "$work/program"
    nm --defined-only "$work/program" | awk '{print $3}' | sort >"$work/symbols"
    join -1 1 -2 1 "$work/symbols" "$work/owners" | awk '{print $2}' | sort -u
}

# expect <law> <the objects of it that not every law needs, in alphabetical order>
expect()
{
    local law=$1 found
    shift
    found=$(comm -23 "$work/$law.linked" "$work/common" | paste -sd' ')
    if [[ $found != "$*" ]]; then
        printf 'law_%s: linked: %s\n  expected: %s\n' "$law" "$found" "$*"
        status=1
    fi
}

laws=(noc noc_speed noc_h conventional dobc pid pi_foc ladrc noc_shaft noc_iron)
for law in "${laws[@]}"; do
    linked "$law" | sort >"$work/$law.linked"
done
cat "$work"/*.linked | sort | uniq -c | awk -v all="${#laws[@]}" '$1 == all {print $2}' >"$work/common"
if grep -E '^(law_|nodo|dobc|nosc|pid_law|near_optimal|foc|speed_difference)' "$work/common"; then
    printf 'linked for every law\n'
    status=1
fi

expect noc angle_gate current_clamp current_ref encoder_form fields_encoder_form fields_near_optimal inertia law_noc law_noc_fields near_optimal near_optimal_position noc_inertia noc_torque nodo nodo_current nodo_encoder nodo_encoder_series nosc nosc_series position_loop position_ref position_torque speed_ref
expect noc_speed current_clamp current_ref fields_near_optimal law_noc_speed law_noc_speed_fields near_optimal nodo nosc nosc_series position_loop speed_ref
expect noc_h angle_gate current_clamp current_ref encoder_form fields_encoder_form fields_near_optimal inertia law_noc_h law_noc_h_fields near_optimal near_optimal_position nodo nodo_encoder nodo_encoder_series nodo_harmonic nosc nosc_series position_loop position_ref position_torque speed_ref
expect noc_iron angle_gate current_clamp current_ref encoder_form fields_encoder_form fields_near_optimal iron law_noc_iron law_noc_iron_fields near_optimal nodo nodo_current nodo_encoder nodo_encoder_series nosc nosc_series position_loop speed_ref
expect noc_shaft angle_gate current_clamp current_ref encoder_form fields_encoder_form fields_near_optimal law_noc_shaft law_noc_shaft_fields near_optimal nodo nodo_encoder nodo_encoder_series nodo_shaft nosc nosc_series position_loop speed_ref
expect conventional conventional current_clamp current_ref double_series fields_near_optimal law_conventional law_conventional_fields law_noc_speed law_noc_speed_fields near_optimal nodo nosc nosc_series position_loop speed_ref
expect dobc dobc fields_pid_law law_dobc law_dobc_fields pid_law
expect pid feedforward fields_pid_law law_pid law_pid_fields pid_law
expect pi_foc angle_gate encoder_form fields_foc foc law_pi_foc law_pi_foc_fields speed_difference speed_observer
expect ladrc angle_gate encoder_form fields_foc foc law_ladrc law_ladrc_fields speed_difference speed_observer
exit "$status"
