(source_file) @local.scope
(block) @local.scope
(fn_statement) @local.scope
(def_statement) @local.scope
(for_statement) @local.scope
(comprehension) @local.scope
(let_in) @local.scope

(let_statement
  name: (identifier) @local.definition)
(param_statement
  name: (identifier) @local.definition)
(pattern
  index: (identifier) @local.definition)
(pattern
  name: (identifier) @local.definition)
(row_pattern
  name: (identifier) @local.definition)
(binding
  name: (identifier) @local.definition)
(parameter
  name: (identifier) @local.definition)
(import_statement
  name: (identifier) @local.definition)

; The names of functions and kinds belong to the file.
((fn_statement
  name: (identifier) @local.definition.function)
  (#set! definition.function.scope "parent"))
((def_statement
  name: (identifier) @local.definition.type)
  (#set! definition.type.scope "parent"))

(reference
  (path . (identifier) @local.reference))
(call
  function: (path . (identifier) @local.reference))
(object
  kind: (path . (identifier) @local.reference))
