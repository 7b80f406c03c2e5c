#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Puts a copy of the Unity test framework into build/unity, for machines that cannot reach its
# upstream repository. Debian and Ubuntu have it in the source package ntpsec. apt uses its own
# source list and state under build/apt; the system's configuration is only read. Exit status: 0
# copy in place, 1 no copy available, 2 an unknown copy.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

files=(unity.c unity.h unity_internals.h)
pins=cmake/unity.sha256
own="use your own with UNITY_ROOT=<dir> ./dev test or cmake -DUNITY_ROOT=<dir>"
copy=build/unity
state=$PWD/build/apt

fail()
{
    printf 'Unity: %s\n' "$2" >&2
    exit "$1"
}

# is_known DIR: every file in DIR has a pinned hash
is_known()
{
    local file sum
    for file in "${files[@]}"; do
        sum=$(cd "$1" && sha256sum "$file" 2>/dev/null) && grep -qxF "$sum" "$pins" || return 1
    done
}

# Prints a deb-src line for each main archive of this distribution that apt is configured with.
# Reads both formats (*.list and *.sources); other archives and suites are left out.
source_lines()
{
    local codename file lists=()
    codename=$(sed -n 's/^VERSION_CODENAME=//p' /etc/os-release | tr -d '"')
    for file in /etc/apt/sources.list /etc/apt/sources.list.d/*.{list,sources}; do
        [[ ! -r $file ]] || lists+=("$file")
    done
    ((${#lists[@]})) || return 0

    awk -v codename="$codename" '
        function emit(uris, suites, components, options,    u, s, i, j, nu, ns, line) {
            if ((" " components " ") !~ /[ \t]main[ \t]/) return
            components = (" " components " ") ~ /[ \t]universe[ \t]/ ? "main universe" : "main"
            nu = split(uris, u, " "); ns = split(suites, s, " ")
            for (i = 1; i <= nu; i++) for (j = 1; j <= ns; j++) {
                if (s[j] != codename && s[j] !~ /^(stable|oldstable|testing|unstable|sid)$/) continue
                line = "deb-src " options u[i] " " s[j] " " components
                if (!seen[line]++) print line
            }
        }
        function flush_stanza(    options) { # of a *.sources file
            options = ""
            if (field["signed-by"] ~ /^[ \t]*\/[^ \t]+[ \t]*$/) {
                gsub(/[ \t]/, "", field["signed-by"])
                options = "[signed-by=" field["signed-by"] "] "
            }
            if (tolower(field["enabled"]) !~ /no|false|off|0/)
                emit(field["uris"], field["suites"], field["components"], options)
            split("", field)
        }
        FNR == 1 { flush_stanza() }
        /^[ \t]*#/ || /cdrom:/ { next }
        FILENAME ~ /\.sources$/ {
            if ($0 ~ /^[ \t]*$/) { flush_stanza(); next }
            if ($0 !~ /^[ \t]/) { name = tolower($1); sub(/:.*/, "", name); sub(/^[^:]*:/, "") }
            field[name] = field[name] " " $0
            next
        }
        $1 == "deb" || $1 == "deb-src" {
            options = ""
            if (match($0, /\[[^]]*\]/)) {
                options = substr($0, RSTART, RLENGTH)
                $0 = substr($0, 1, RSTART - 1) " " substr($0, RSTART + RLENGTH)
                if (match(options, /signed-by=[^] \t]+/))
                    options = "[" substr(options, RSTART, RLENGTH) "] "
                else options = ""
            }
            uri = $2; suite = $3; $1 = $2 = $3 = ""
            emit(uri, suite, $0, options)
        }
        END { flush_stanza() }' "${lists[@]}"
}

# download LINE: fetches the upstream tarball of ntpsec into $state, checked by apt
download()
{
    local options=(-q -o Dir::Etc::sourcelist="$state/sources.list"
        -o Dir::Etc::sourceparts=/dev/null -o Dir::State::lists="$state/lists"
        -o Dir::Cache="$state/cache" -o APT::Sandbox::User=root
        -o Acquire::Retries=1 -o Acquire::http::Timeout=30 -o Acquire::https::Timeout=30)
    printf '%s\n' "$1" >"$state/sources.list"
    apt-get "${options[@]}" update || true # success is judged by what arrives
    cd "$state" && apt-get "${options[@]}" source --download-only --tar-only ntpsec
}

if [[ -e $copy ]]; then
    is_known "$copy" ||
        fail 2 "$copy is not a known copy: delete it, or $own"
    exit 0
fi
command -v apt-get >/dev/null || fail 1 "no apt here to download it with"

trap 'rm -rf "$state"' EXIT
rm -rf "$state"
mkdir -p "$state"/{lists,cache/archives}/partial "$state/unity"
source_lines >"$state/candidates"
while read -r line; do
    (download "$line") </dev/null >>"$state/log" 2>&1 && break
done <"$state/candidates"

tarball=$(compgen -G "$state/ntpsec_*.orig.tar.*" | head -n 1) || {
    tail -n 5 "$state/log" >&2 || true
    fail 1 "the source package ntpsec could not be downloaded with apt"
}
tar -xf "$tarball" -C "$state/unity" --strip-components=3 --wildcards \
    "${files[@]/#/*/tests/unity/}" || fail 2 "not found in $(basename "$tarball")"
is_known "$state/unity" || fail 2 \
    "the copy in $(basename "$tarball") is not in $pins: $own"
mv "$state/unity" "$copy"
