#!/bin/bash
# Installs the build tree beside itself and builds a user's program against it, by find_package and
# by pkg-config.
# usage: run.sh BUILD_DIR VERSION C_COMPILER CXX_COMPILER LIBDIR SHARED SANITIZE
#   LIBDIR: relative to the prefix; SHARED: ON or OFF; SANITIZE: as in -fsanitize=, or empty
set -eu
build=$1 version=$2 cc=$3 cxx=$4 libdir=$5 shared=$6 sanitize=$7
source=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
place=$build/install-test
prefix=$place/moved
flags=${sanitize:+-fsanitize=$sanitize}

step() { printf '\n== %s\n' "$*"; }

# The name of the folder changes after installing: nothing may depend on where it was.
step install
rm -rf "$place"
mkdir -p "$place"
cmake --install "$build" --prefix "$place/first" >"$place/install.log"
mv "$place/first" "$prefix"

step 'the installed program, manual and completion'
"$prefix/bin/glint" --version | grep -Fx "glint $version"
test -s "$prefix/share/man/man1/glint.1"
bash -n "$prefix/share/bash-completion/completions/glint"

step 'find_package, from a project in C alone'
CC=$cc CFLAGS=$flags LDFLAGS=$flags cmake -S "$source" -B "$place/cmake" -DCMAKE_BUILD_TYPE=Debug \
    -DCMAKE_PREFIX_PATH="$prefix" -DWANTED_VERSION="$version" >"$place/cmake.log"
cmake --build "$place/cmake"
"$place/cmake/consumer" | grep -Fx "glint $version: status 1, 1 errors"

step 'find_package refuses a version that it is not'
if CC=$cc cmake -S "$source" -B "$place/refused" -DCMAKE_PREFIX_PATH="$prefix" -DWANTED_VERSION=99.0 \
    >"$place/refused.log" 2>&1; then
    echo 'version 99.0 was accepted' >&2
    exit 1
fi

step 'pkg-config'
export PKG_CONFIG_PATH=$prefix/$libdir/pkgconfig${PKG_CONFIG_PATH:+:$PKG_CONFIG_PATH}
test "$(pkg-config --modversion glint)" = "$version"
static=--static
if [ "$shared" = ON ]; then
    static=
    export LD_LIBRARY_PATH=$prefix/$libdir${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
fi
# shellcheck disable=SC2046,SC2086 # words are wanted
"$cc" $flags $(pkg-config --cflags glint) "$source/consumer.c" -o "$place/consumer" \
    $(pkg-config $static --libs glint)
"$place/consumer" | grep -Fx "glint $version: status 1, 1 errors"

step 'the header in C99 with all warnings, and in C++'
# shellcheck disable=SC2046
"$cc" -std=c99 -pedantic-errors -Wall -Wextra -Werror $(pkg-config --cflags glint) -fsyntax-only \
    "$source/consumer.c"
# shellcheck disable=SC2046
"$cxx" -std=c++11 -pedantic-errors -Wall -Wextra -Werror $(pkg-config --cflags glint) -fsyntax-only \
    -x c++ "$source/consumer.c"
