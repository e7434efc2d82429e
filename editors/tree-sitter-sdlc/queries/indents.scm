; @indent.begin, @indent.branch and @indent.end are for Neovim, @indent and @outdent for Helix.

[
  (block)
  (parameters)
  (arguments)
  (group)
  (triple)
  (list)
  (comprehension)
  (row_pattern)
  (index)
] @indent.begin @indent

[
  ")"
  "]"
  "}"
] @indent.branch @indent.end @outdent
