#!/bin/bash
# Fails where an #include breaks the order of the folders of src/.
# usage: test_rooms.sh ROOT
set -u

# What each folder may include besides the C library and glint.h.
declare -A rooms=(
    [base]='base'
    [orbit]='base orbit'
    [brdf]='base brdf'
    [facets]='base brdf facets'
    [scenario]='base orbit brdf facets scenario'
    [lightcurve]='base orbit brdf facets scenario lightcurve'
    [output]='base output'
    [cli]='cli'
)
# Which folder's C++ files face which library; those of the pattern below are C.
declare -A libraries=([erfa]='orbit' [GeographicLib]='orbit' [toml++]='scenario'
    [cminpack]='brdf' [expat]='orbit' [jansson]='orbit' [cairo]='output' [embree3]='facets')

wrong() {
    printf '%s: %s\n' "$1" "$2"
    failures=$((failures + 1))
}

# check_include FILE ROOM NAME QUOTE
check_include() {
    local file=$1 room=$2 name=$3 quote=$4 library
    if [ "$quote" = '"' ]; then
        case " ${rooms[$room]} " in
            *" ${name%%/*} "*) [ -e "$root/src/$name" ] || wrong "$file" "there is no $name" ;;
            *) [ "$name" = glint_version.h ] || wrong "$file" "$room must not include $name" ;;
        esac
        return
    fi
    for library in "${!libraries[@]}"; do
        case $name in
            "$library"/* | "$library".h | "$library"m.h)
                [ "${libraries[$library]}" = "$room" ] ||
                    wrong "$file" "$name belongs to ${libraries[$library]}, not to $room"
                [[ $library =~ ^(erfa|cminpack|expat|jansson|cairo|embree3)$ ]] || [ "${file##*.}" = cpp ] ||
                    wrong "$file" "only a .cpp file may include $name"
                return
                ;;
        esac
    done
    case $name in
        glint/glint.h) ;;
        *.h) [ -e "$root/src/$name" ] && wrong "$file" "write \"$name\", not <$name>" ;;
        *) [ "${file##*.}" = cpp ] || wrong "$file" "only a .cpp file may include <$name>" ;;
    esac
}

# Checks a tree; prints what is wrong, and returns 1 if anything is.
check_tree() {
    root=$1 failures=0
    local file room line pattern='^[[:space:]]*#[[:space:]]*include[[:space:]]*([<"])([^>"]*)[>"]'
    while IFS= read -r file; do
        room=${file#"$root"/src/}
        room=${room%%/*}
        if [ -z "${rooms[$room]-}" ]; then
            wrong "$file" "no folder '$room' is known"
            continue
        fi
        while IFS= read -r line; do
            [[ $line =~ $pattern ]] &&
                check_include "$file" "$room" "${BASH_REMATCH[2]}" "${BASH_REMATCH[1]}"
        done < <(grep -E '^[[:space:]]*#[[:space:]]*include' "$file")
    done < <(find "$root/src" -name '*.c' -o -name '*.h' -o -name '*.cpp' | sort)
    grep -HnE '^[[:space:]]*#[[:space:]]*include' "$root/include/glint/glint.h" |
        grep -vE '<std[a-z]+\.h>' && wrong include/glint/glint.h 'only <std*.h> may be included'
    [ "$failures" = 0 ]
}

# plant PATH INCLUDE: a small tree in which that file includes that; true when it is found out.
plant() {
    local tree
    tree=$(mktemp -d)
    mkdir -p "$tree/include/glint" "$tree/src/base" "$tree/src/facets" "$tree/$(dirname "$1")"
    touch "$tree/include/glint/glint.h" "$tree/src/base/text.h" "$tree/src/facets/model.h"
    check_tree "$tree" >/dev/null || echo "the empty tree fails"
    echo "#include $2" >>"$tree/$1"
    check_tree "$tree" >/dev/null
    local found=$?
    rm -rf "$tree"
    [ "$found" = 1 ]
}

status=0
check_tree "$1" || status=1

# The check itself must be able to fail.
while read -r path include; do
    plant "$path" "$include" || {
        echo "not found out: $path with #include $include"
        status=1
    }
done <<'END'
src/orbit/a.c "facets/model.h"
src/brdf/a.h "facets/model.h"
src/base/text.h "facets/model.h"
src/output/a.c "facets/model.h"
src/cli/a.c "base/text.h"
src/cli/a.c   "facets/model.h"
src/orbit/a.c <facets/model.h>
src/orbit/a.c "base/absent.h"
src/orbit/a.c "model.h"
src/facets/a.c <erfa.h>
src/orbit/a.c <cminpack.h>
src/lightcurve/a.cpp <toml++/toml.h>
src/orbit/a.c <GeographicLib/Geocentric.hpp>
src/base/a.c <vector>
src/other/a.c <math.h>
include/glint/glint.h "base/text.h"
END
exit "$status"
