#!/bin/sh
# What `meson install` makes is whole and works wherever it is moved to: program, headers, plugins,
# pkg-config file, man page, completion, examples, schema and reference pages.
# install.sh BUILD_DIRECTORY SOURCE_ROOT PREFIX
set -eu
build=$1 source=$2 prefix=$3
for tool in groff mandoc fish; do
    command -v $tool >/dev/null || { echo "needs $tool" && exit 77; }
done
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT
unset FLANKFILM_PLUGIN_PATH
export XDG_DATA_HOME="$lab/home" # no plugins of the user's

meson install -C "$build" --no-rebuild --quiet --destdir "$lab/root" >"$lab/said" 2>&1 || {
    cat "$lab/said"
    exit 1
}
mv "$lab/root$prefix" "$lab/moved"
export PATH="$lab/moved/bin:$PATH"
[ "$(command -v flankfilm)" = "$lab/moved/bin/flankfilm" ]

say() { echo "$1: ${2:-good}"; }

# the program finds the models that came with it, and no others
flankfilm models --markdown | sed -n 's/^- \[\([^]]*\)\].*/\1/p' >"$lab/ids"
(cd "$build/plugins" && ls -d */*.so) | sed 's/\.so$//' | sort >"$lab/built"
sort "$lab/ids" | diff - "$lab/built"
id=$(head -n 1 "$lab/ids")
flankfilm models "$id" | grep -q "^file *$lab/moved/"
say models "$(wc -l <"$lab/ids")"

# pkg-config
pc=$(find "$lab/moved" -name flankfilm.pc)
PKG_CONFIG_PATH=$(dirname "$pc")
export PKG_CONFIG_PATH
plugins=$(pkg-config --variable=plugindir flankfilm)
[ -f "$plugins/$id.so" ]
[ "$(pkg-config --variable=abi flankfilm)" = 1.0 ]
for header in "$source"/include/flankfilm/*.h; do
    echo "#include <flankfilm/$(basename "$header")>" >"$lab/one.c"
    # shellcheck disable=SC2046
    cc -std=c99 -Wall -Wextra -Wpedantic -Werror -fsyntax-only $(pkg-config --cflags flankfilm) "$lab/one.c"
done
say pkg-config

# the man page has every command and option that the program has, and is laid out well
man="$lab/moved/share/man/man1/flankfilm.1"
sh "$source/docs/man.sh" flankfilm | diff - "$man"
tr -d '\\' <"$man" >"$lab/plain"
flankfilm --help | sed -n 's/^  \([a-z][a-z]*\) .*/\1/p' >"$lab/commands"
for word in run check explain models verify; do grep -qx $word "$lab/commands"; done
for command in $(grep -v help "$lab/commands"); do
    grep -qx "\.SS $command" "$lab/plain"
    flankfilm help "$command" | grep -o '^  .*' | grep -o -- '--[a-z][a-z-]*' | sort -u | while read -r option; do
        sed -n "/^\.SS $command\$/,/^\.S[SH] /p" "$lab/plain" | grep -q -- "$option" ||
            { echo "$command $option is not in the man page" && exit 1; }
    done
done
[ -z "$(groff -man -ww -Tutf8 -z "$man" 2>&1)" ]
mandoc -T lint -W warning "$man" >"$lab/lint" || true
if grep -v 'missing date' "$lab/lint"; then exit 1; fi
say "man page"

# completion asks the program
complete_bash() { # WORD...: what is offered for the last one
    bash -c '. "$0"; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _flankfilm 2>/dev/null; echo ${COMPREPLY[@]}' \
        "$lab/moved/share/bash-completion/completions/flankfilm" "$@"
}
[ "$(complete_bash flankfilm expla)" = explain ]
[ "$(complete_bash flankfilm run --fail)" = --fail-fast ]
[ "$(complete_bash flankfilm run x.yaml --set viscosity.use = viscosity/b)" = viscosity/barus ]
[ "$(complete_bash flankfilm models viscosity/b)" = viscosity/barus ]
[ "$(complete_bash flankfilm new visc)" = viscosity/ ]
[ "$(complete_bash flankfilm help mod)" = models ]
while read -r command; do
    case " $(complete_bash flankfilm '') " in *" $command "*) ;; *) echo "no $command" && exit 1 ;; esac
done <"$lab/commands"
complete_fish() { fish -c "source $lab/moved/share/fish/vendor_completions.d/flankfilm.fish; complete -C '$1'" | cut -f 1 | xargs; }
[ "$(complete_fish 'flankfilm expla')" = explain ]
[ "$(complete_fish 'flankfilm models viscosity/b')" = viscosity/barus ]
[ "$(complete_fish 'flankfilm run --fail')" = --fail-fast ]
say completion

# examples, schema, pages
cd "$lab/moved/share"
count=0
for file in flankfilm/configs/*.yaml flankfilm/configs/studies/*.yaml; do
    flankfilm check "$file" >/dev/null
    count=$((count + 1))
done
[ "$count" -ge 6 ]
cp flankfilm/configs/own-gear.yaml "$lab/mine.yaml" # its card is found from anywhere
flankfilm check "$lab/mine.yaml" >/dev/null
while read -r id; do
    case $id in
    conformance/* | executor/*) ! grep -q "\"$id\": {" flankfilm/flankfilm.schema.json || exit 1 ;; # no stage uses it
    *) grep -q "\"$id\": {" flankfilm/flankfilm.schema.json ;;
    esac
    head -n 1 "doc/flankfilm/reference/$id.md" | grep -qx "# $id"
    flankfilm models "$id" --markdown | diff - "doc/flankfilm/reference/$id.md"
done <"$lab/ids"
# rows of a table have as many cells as its head
cat doc/flankfilm/reference/*/*.md | sed 's/\\|//g' | awk '
    /^\|/ { n = gsub(/\|/, "|"); if (cells && n != cells) { print; bad = 1 } cells = n; next }
    { cells = 0 }
    END { exit bad }'
# each file that the pages for authors name is there
grep -ohE '`(plugins|tests|docs|include|flankfilm)/[a-z0-9/_-]*\.?[a-z0-9]*`' doc/flankfilm/plugins.md doc/flankfilm/first-plugin.md | tr -d '`' | sort -u >"$lab/named"
[ "$(wc -l <"$lab/named")" -ge 20 ]
while read -r named; do
    case $named in
    docs/*) [ -f "doc/flankfilm/${named#docs/}" ] ;;
    include/*) [ -f "../$named" ] ;;
    flankfilm/*) [ -e "../include/$named" ] ;;
    plugins/toy/wide.so) ;; # made there by a command
    *) [ -e "doc/flankfilm/source/$named" ] ;;
    esac || { echo "a page for authors names $named, which is not installed" && exit 1; }
done <"$lab/named"
# and so is the template of each kind that its table has
awk -F'|' '/^\| kind \| what `flankfilm new/ { on = 1 } !/^\|/ { on = 0 } on { print $2 }' doc/flankfilm/plugins.md |
    grep -o '`[a-z]*`' | tr -d '`' >"$lab/kinds"
[ "$(wc -l <"$lab/kinds")" -ge 14 ]
while read -r kind; do
    [ -f "$plugins/$kind.template.c" ] || { echo "plugins.md has a template of $kind, which is not installed" && exit 1; }
done <"$lab/kinds"
say "examples, schema and pages" "$count examples"
