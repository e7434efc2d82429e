[
  (block)
  (parameters)
  (arguments)
  (list)
  (comprehension)
  (block_comment)
] @fold
