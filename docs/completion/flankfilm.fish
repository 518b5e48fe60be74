# Completion of flankfilm for fish; it asks the program, so that both always agree.

function __flankfilm_commands
    flankfilm --help 2>/dev/null | string match -rg '^  ([a-z]+ .*)$' | string replace -r '^(\S+)\s+\S+\s+' '$1\t'
end

function __flankfilm_models
    flankfilm models --markdown 2>/dev/null | string match -rg '^- \[(.*)$' | string replace -r '\]\(.*?\): ' \t
end

function __flankfilm_options
    set -l words (commandline -opc)
    flankfilm help $words[2] 2>/dev/null | string match -rg -- '^  .*?(--[a-z].*)$' | string replace -r '^(--[a-z-]+).*?  +' '$1\t'
end

complete -c flankfilm -n __fish_use_subcommand -f -a '(__flankfilm_commands)'
complete -c flankfilm -n '__fish_seen_subcommand_from models' -f -a '(__flankfilm_models)'
complete -c flankfilm -n '__fish_seen_subcommand_from help' -f -a '(__flankfilm_commands)'
complete -c flankfilm -n 'not __fish_use_subcommand; and string match -q -- "-*" (commandline -ct)' -f -a '(__flankfilm_options)'
