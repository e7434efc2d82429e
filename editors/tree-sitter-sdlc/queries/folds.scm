[
  (block)
  (parameters)
  (arguments)
  (list)
  (block_comment)
] @fold
