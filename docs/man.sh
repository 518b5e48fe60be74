#!/bin/sh
# The man page flankfilm(1), made of what the program says of itself.
#   man.sh FLANKFILM >flankfilm.1
set -eu
flankfilm=$1
# Text that groff takes for itself is made plain.
plain() { sed -e 's/\\/\\e/g' -e 's/-/\\-/g' -e "s/^\\([.']\\)/\\\\\\&\\1/"; }
commands=$("$flankfilm" --help | sed -n 's/^  \([a-z][a-z]*\) .*/\1/p' | grep -v '^help$')
version=$("$flankfilm" --version | cut -d' ' -f2)

echo ".TH FLANKFILM 1 \"\" \"flankfilm $version\" \"User Commands\""
echo ".SH NAME"
echo "flankfilm \\- gear vibration and the oil film between the teeth of spur gears"
echo ".SH SYNOPSIS"
break=
for command in $commands; do
    "$flankfilm" help "$command" | sed -n '1s/^usage: //p' | plain |
        sed -e "s/^flankfilm \\([a-z]*\\) */$break.B flankfilm \\1\\n/"
    break=".br\\n"
done
echo ".SH DESCRIPTION"
"$flankfilm" --help | sed -n '1,/^$/p' | sed '/^$/d' | plain
echo "Everything physical is a plugin; a YAML file says which models are used and how they are wired."
echo ".SH COMMANDS"
for command in $commands; do
    echo ".SS $command"
    "$flankfilm" help "$command" | plain | awk '
        NR <= 2 { next }
        /^options:$/ { options = 1; next }
        /^$/ { next }
        options && /^  +\\-/ {
            text = substr($0, 3)
            gap = match(text, /  +/)
            print ".TP"
            print ".B " (gap ? substr(text, 1, gap - 1) : text)
            if (gap) print substr(text, gap + RLENGTH)
            next
        }
        { sub(/^ +/, ""); print }'
done
echo ".SH EXIT STATUS"
"$flankfilm" --help | sed -n 's/^exit codes: //; t found; b
:found
N; s/\n */ /; p' | tr ',' '\n' | sed 's/^ *//' | plain |
    sed 's/^\([0-9]\) \(.*\)/.TP\n.B \1\n\2/'
cat <<'EOF'
.SH ENVIRONMENT
.TP
.B FLANKFILM_PLUGIN_PATH
directories of plugins, parted by colons, that are searched after those of
.B \-\-plugin\-path
.TP
.B FLANKFILM_VERIFY_LIMIT
seconds that a test of
.B flankfilm verify
may take
.TP
.B NO_COLOR
no colour in messages
.SH FILES
.TP
.I ~/.local/share/flankfilm/plugins
plugins of your own
.SH SEE ALSO
The reference page of each model:
.BR "flankfilm models" " ID."
The schema for editors:
.BR "flankfilm schema" .
EOF
