#compdef sdlc
# Completion of sdlc in zsh: source <(sdlc completions zsh)
_sdlc() {
  local line
  local -a candidates
  while IFS= read -r line; do
    candidates+=("${${line%%$'\t'*}//:/\\:}:${line#*$'\t'}")
  done < <(sdlc complete -- $((CURRENT - 1)) "${words[@]}" 2>/dev/null)
  if ((${#candidates})); then _describe sdlc candidates; else _files; fi
}
compdef _sdlc sdlc
