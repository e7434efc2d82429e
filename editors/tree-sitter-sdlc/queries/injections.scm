; TODO, FIXME and addresses in comments, where the editor has that grammar.
([
  (line_comment)
  (block_comment)
  (doc_comment)
] @injection.content
  (#set! injection.language "comment"))
