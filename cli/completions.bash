# Completion of sdlc in bash: source <(sdlc completions bash)
_sdlc() {
  local candidate
  COMPREPLY=()
  while IFS= read -r candidate; do
    COMPREPLY+=("${candidate%%$'\t'*}")
  done < <(sdlc complete -- "$COMP_CWORD" "${COMP_WORDS[@]}" 2>/dev/null)
  # A value follows at once.
  [[ ${#COMPREPLY[@]} -eq 1 && ${COMPREPLY[0]} == *= ]] && compopt -o nospace
}
complete -o default -o bashdefault -F _sdlc sdlc
