(fn_statement
  name: (identifier) @name) @definition.function
(def_statement
  name: (identifier) @name) @definition.class
(let_statement
  name: (identifier) @name) @definition.constant
(param_statement
  name: (identifier) @name) @definition.constant
(call
  function: (path (identifier) @name .)) @reference.call
(object
  kind: (path (identifier) @name .)) @reference.class
