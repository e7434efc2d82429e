# Completion of sdlc in fish: sdlc completions fish | source
function __sdlc_complete
    set -l words (commandline -opc)
    sdlc complete -- (count $words) $words (commandline -ct) 2>/dev/null
end
complete -c sdlc -a '(__sdlc_complete)'
