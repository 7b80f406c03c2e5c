#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Frama-C's Eva over the control core (docs/assurance.md, "Proved"):
#
#     prove.sh                  everything, as many analyses at once as there are cores
#     prove.sh LAW ENTRY        one: prove.sh noc prove_tick; prove.sh any prove_gate
#
# Every analysis has to end without an alarm and with every property shown. Logs in build/prove/.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

core=firmware/control
app=firmware/app
board=firmware/board/f28335
config=firmware/config
includes=$(find "$core" "$app" firmware/{commission,store} -type d -printf '-I%p ')
laws=(noc noc_speed noc_h conventional dobc pid pi_foc ladrc noc_shaft noc_iron)

# How many states are told apart in these functions; in others Eva joins them where paths meet.
declare -A apart=(
    [prove_tick]=double_series_row:200,dobc_update:400
    [prove_init]=check:100,check_finite:60,check_parity:30,check_rows:2000,conventional_check:200,dobc_check:300,\
drive_config_check:100,drive_init:50,limits_ok:20,near_optimal_check:50,nodo_check:200,nodo_encoder_check:200,\
nodo_harmonic_check:400,nodo_parity_check:100,nosc_check:200,numbers_ok:50,order_ok:5,prove_init:50,\
speed_difference_check:20,terms_ok:50
    [prove_gate]=prove_gate:50
    [prove_app_tick]=prove_app_tick:2
    [prove_control]=app_control_tick:200,app_control_decide:200,app_control_aim:200,step:200,change_at_rest:50,change_enabled:100,by_modes:20,prove_control:200,tick_control:200
    [prove_modbus]=app_modbus_device_identify:50,is_known:20
)
apart[prove_canopen]=app_canopen_node_listen:40,app_canopen_dictionary_read:140,find_value:20,read_single:10,app_canopen_pdo_reset:10,app_canopen_block_text:10,read_identity:10
apart[prove_canopen_block]=prove_canopen_block:50,any_can_registers:50,app_canopen_block_read:50,app_canopen_block_write:50,app_registers_read_input:50,app_registers_read_holding:50
apart[prove_canopen_pdo]=pass_objects:40
apart[prove_store]=use:1
apart[prove_refused]=${apart[prove_init]}
apart[prove_parameters]=app_registers_saved_take:300,app_registers_saved_read:300,read_map:400,store_newest:20,\
accept:50,app_image_accept:50,take_record:20,app_parameters_take:50
apart[prove_loader]=${apart[prove_init]/prove_init:50,/},drive_image_read_part:50,drive_image_fields:50,app_image_take:50,commit:50,\
app_loader_work:20,app_loader_write:50,put_board:100
apart[prove_image]=prove_image:80,drive_image_read:200
texts=find_value:full,read_single:full,read_identity:full,app_canopen_block_text:full
rows=app_registers_place_value,app_canopen_objects_write,app_canopen_objects_try,app_registers_fits
declare -A options=(
    [prove_tick]=""
    [prove_init]="-eva-split-return full"
    [prove_refused]=""
    [prove_gate]="-eva-partition-history 6 -eva-interprocedural-history"
    [prove_app_tick]=""
    [prove_control]="-eva-partition-history 4 -eva-interprocedural-history"
    [prove_modbus]="-eva-min-loop-unroll 130"
    [prove_canopen]="-eva-min-loop-unroll 8 -eva-ilevel 128 -eva-split-return-function $texts -eva-use-spec $rows,app_canopen_pdo_act,app_canopen_pdo_try,app_canopen_pdo_read,app_canopen_block_read,app_canopen_block_write"
    [prove_canopen_pdo]="-eva-min-loop-unroll 8 -eva-use-spec $rows"
    [prove_canopen_rows]="-eva-min-loop-unroll 150"
    [prove_canopen_block]="-eva-min-loop-unroll 130"
    [prove_store]=""
    [prove_image]="-eva-split-return full"
    [prove_loader]="-eva-split-return full"
    [prove_parameters]="-eva-interprocedural-splits"
    [prove_commission_spin]="-eva-min-loop-unroll 66" # COMMISSION_WINDOWS and two
)
# Where each entry is; beside the core it needs the application, or not.
declare -A sources=(
    [prove_tick]=tests/prove/prove_tick.c
    [prove_init]=tests/prove/prove_tick.c
    [prove_refused]=tests/prove/prove_tick.c
    [prove_gate]=tests/prove/prove_gate.c
    [prove_app_tick]=tests/prove/prove_app.c
    [prove_control]=tests/prove/prove_app.c
    [prove_modbus]=tests/prove/prove_load.c
    [prove_canopen]=tests/prove/prove_load.c
    [prove_canopen_rows]=tests/prove/prove_load.c
    [prove_canopen_block]=tests/prove/prove_load.c
    [prove_canopen_pdo]=tests/prove/prove_load.c
    [prove_store]=tests/prove/prove_store.c
    [prove_image]=tests/prove/prove_store.c
    [prove_loader]=tests/prove/prove_load.c
    [prove_parameters]=tests/prove/prove_load.c
)
stages=(rest check look resistance drag map spin ring)
for stage in "${stages[@]}"; do
    sources[prove_commission_$stage]=tests/prove/prove_commission.c
done

# files_of LAW ENTRY: the core with one law, or with none, and the application where the entry is one of its
files_of()
{
    printf '%s\n' "${sources[$2]}"
    [[ ${sources[$2]} != *prove_load.c ]] || { find "$app" firmware/store -name '*.c' ! -name app.c && echo "$config/board_config.c"; }
    [[ ${sources[$2]} != *prove_app.c ]] || { find "$app" -name 'app_*.c' && echo "$config/board_config.c"; }
    [[ ${sources[$2]} != *prove_store.c ]] || { find firmware/store -name '*.c' && printf '%s\n' "$app"/load/{board_identity,drive_image,fields_app,fields_text}.c; }
    [[ ${sources[$2]} != *prove_commission.c ]] || find firmware/commission -name '*.c'
    find "$core" -name '*.c' ! -name 'law_*.c'
    case $1 in
        any) ;;
        conventional) printf '%s\n' "$core"/{laws/law_conventional,laws/law_noc_speed,fields/law_conventional_fields,fields/law_noc_speed_fields}.c ;;
        *) printf '%s\n' "$core/laws/law_$1.c" "$core/fields/law_$1_fields.c" ;;
    esac
}

analyse()
{
    local law=$1 entry=$2 log=build/prove/$1.$2.log begin=$SECONDS files alarms open
    mapfile -t files < <(files_of "$law" "$entry")
    # gcc_x86_16: int 16 bits, long and pointers 32, as on the target. Its char has 8.
    # shellcheck disable=SC2086 # options are words
    frama-c -machdep gcc_x86_16 -c11 -cpp-extra-args="$includes -I$board/.. -I$board -DBOARD_CURRENT_SENSORS=3 -DBOARD_CHOPPER=1 -DPROVE_$law -DPROVE_LAW=$law" "${files[@]}" \
        -eva -main "$entry" -lib-entry -warn-special-float none -eva-precision 3 -eva-msg-key=-initial-state,-final-states \
        ${apart[$entry]:+-eva-slevel-function "${apart[$entry]}"} ${options[$entry]:-} >"$log" 2>&1 || true
    alarms=$(grep -c 'eva:alarm' "$log" || true)
    open=$(sed -n 's/^ *\([0-9]*\)% of the logical properties reached have been proven.*/\1/p' "$log")
    if ! grep -q '0 alarms generated by the analysis' "$log" || ((alarms != 0)); then
        printf '%-13s %-27s NOT proved: %s\n' "$law" "$entry" "$log"
        grep -A2 -E 'eva:alarm|User Error' "$log" || tail -3 "$log"
        return 1
    fi
    printf '%-13s %-27s 0 alarms, %s %% of the properties (%d s)\n' "$law" "$entry" "${open:-100}" "$((SECONDS - begin))"
}

mkdir -p build/prove
if (($# == 2)); then
    analyse "$1" "$2"
    exit
fi
for law in "${laws[@]}"; do
    printf "%s\n" "$law prove_tick" "$law prove_init"
    [[ $law == pid ]] || printf "%s\n" "$law prove_refused" # it has no whole constants
done | { printf '%s\n' 'any prove_gate' 'any prove_app_tick' 'any prove_control' 'any prove_store' 'noc prove_image' \
    'noc prove_loader' 'any prove_parameters' 'any prove_modbus' \
    'any prove_canopen' 'any prove_canopen_pdo' 'any prove_canopen_rows' 'any prove_canopen_block' &&
    printf 'any prove_commission_%s\n' "${stages[@]}" && cat; } | xargs -P "$(nproc)" -L 1 tests/prove/prove.sh
