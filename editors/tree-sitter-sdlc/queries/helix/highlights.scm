; Written by a test of sdlc from ../highlights.scm, with the names of Helix.

(line_comment) @comment
(block_comment) @comment
(doc_comment) @comment.line.documentation

[
  "let"
  "param"
  "assert"
  "scene"
] @keyword
[
  "import"
  "as"
  "include"
] @keyword.control.import
[
  "fn"
  "def"
] @keyword.function
[
  "for"
  "in"
] @keyword.control.repeat
[
  "if"
  "then"
  "else"
] @keyword.control.conditional
[
  "and"
  "or"
  "not"
] @keyword.operator

(true) @constant.builtin.boolean
(false) @constant.builtin.boolean
(number) @constant.numeric
(version) @constant.numeric
(color) @string.special
(string) @string
(escape_sequence) @constant.character.escape

[
  "="
  "=="
  "!="
  "<="
  ">="
  "<"
  ">"
  "+"
  "-"
  "*"
  "/"
  "^"
  ".."
] @operator
[
  ":"
  ","
  "."
] @punctuation.delimiter
[
  "("
  ")"
  "["
  "]"
  "{"
  "}"
] @punctuation.bracket

; Labels
(property
  name: (label) @variable.other.member)
(argument
  name: (label) @variable.parameter)
(object
  name: (identifier) @label)

; Declarations
(let_statement
  name: (identifier) @variable)
(param_statement
  name: (identifier) @variable)
(pattern
  index: (identifier) @variable)
(pattern
  name: (identifier) @variable)
(row_pattern
  name: (identifier) @variable)
(binding
  name: (identifier) @variable)
(parameter
  name: (identifier) @variable.parameter)
(import_statement
  name: (identifier) @namespace)
(fn_statement
  name: (identifier) @function)
(def_statement
  name: (identifier) @type)

; Types and kinds; `file.kind` is a kind of an imported file
((type) @type.builtin
  (#match? @type.builtin "^(interval|material|angles|number|string|angle|color|bool|list|vec3)$")) ; types
((type) @type
  (#not-match? @type "^(interval|material|angles|number|string|angle|color|bool|list|vec3)$")) ; types
((object
  kind: (path . (identifier) @type.builtin .))
  (#match? @type.builtin "^(background|animation|camera|render|sphere|group)$")) ; kinds
((object
  kind: (path . (identifier) @type .))
  (#not-match? @type "^(background|animation|camera|render|sphere|group)$")) ; kinds
(object
  kind: (path (identifier) @namespace . "." ))
(object
  kind: (path "." (identifier) @type .))

; Calls
((call
  function: (path . (identifier) @constructor .))
  (#match? @constructor "^(transmissive|linear255|emissive|specular|diffuse|kelvin|linear|unlit|line|hsl|rgb)$")) ; constructors
((call
  function: (path . (identifier) @function.builtin .))
  (#match? @function.builtin "^(random_in_sphere|random_on_sphere|random_in_disc|random_normal|ease_in_out|smoothstep|normalize|ease_out|ease_in|reverse|length|random|rotate|atan2|clamp|cross|floor|fract|noise|range|remap|round|acos|asin|ceil|sign|sort|sqrt|abs|all|any|cos|dot|exp|len|log|max|min|mix|mod|sin|str|sum|tan|zip)$")) ; functions
((call
  function: (path . (identifier) @function .))
  (#not-match? @function "^(random_in_sphere|random_on_sphere|random_in_disc|random_normal|transmissive|ease_in_out|smoothstep|linear255|normalize|ease_out|emissive|specular|diffuse|ease_in|reverse|kelvin|length|linear|random|rotate|atan2|clamp|cross|floor|fract|noise|range|remap|round|unlit|acos|asin|ceil|line|sign|sort|sqrt|abs|all|any|cos|dot|exp|hsl|len|log|max|min|mix|mod|rgb|sin|str|sum|tan|zip)$")) ; functions and constructors
(call
  function: (path (identifier) @namespace . "."))
(call
  function: (path "." (identifier) @function .))

; Values: a path is a name of an imported file or a member of a value
((reference
  (path . (identifier) @constant.builtin))
  (#match? @constant.builtin "^(lightgoldenrodyellow|mediumspringgreen|mediumaquamarine|mediumslateblue|mediumturquoise|mediumvioletred|blanchedalmond|cornflowerblue|darkolivegreen|lightslategray|lightslategrey|lightsteelblue|mediumseagreen|darkgoldenrod|darkslateblue|darkslategray|darkslategrey|darkturquoise|lavenderblush|lightseagreen|palegoldenrod|paleturquoise|palevioletred|rebeccapurple|antiquewhite|darkseagreen|lemonchiffon|lightskyblue|mediumorchid|mediumpurple|midnightblue|darkmagenta|deepskyblue|floralwhite|forestgreen|greenyellow|lightsalmon|lightyellow|navajowhite|saddlebrown|springgreen|yellowgreen|aquamarine|blueviolet|chartreuse|darkorange|darkorchid|darksalmon|darkviolet|dodgerblue|ghostwhite|lightcoral|lightgreen|mediumblue|papayawhip|powderblue|sandybrown|whitesmoke|aliceblue|burlywood|cadetblue|chocolate|darkgreen|darkkhaki|firebrick|gainsboro|goldenrod|indianred|lawngreen|lightblue|lightcyan|lightgray|lightgrey|lightpink|limegreen|mintcream|mistyrose|olivedrab|orangered|palegreen|peachpuff|rosybrown|royalblue|slateblue|slategray|slategrey|steelblue|turquoise|cornsilk|darkblue|darkcyan|darkgray|darkgrey|deeppink|honeydew|lavender|moccasin|seagreen|seashell|crimson|darkred|dimgray|dimgrey|fuchsia|hotpink|magenta|oldlace|skyblue|thistle|bisque|indigo|maroon|orange|orchid|purple|salmon|sienna|silver|tomato|violet|yellow|azure|beige|black|brown|coral|green|ivory|khaki|linen|olive|wheat|white|aqua|blue|cyan|gold|gray|grey|lime|navy|peru|pink|plum|snow|teal|time|red|tan|pi)$")) ; values
((reference
  (path . (identifier) @variable))
  (#not-match? @variable "^(lightgoldenrodyellow|mediumspringgreen|mediumaquamarine|mediumslateblue|mediumturquoise|mediumvioletred|blanchedalmond|cornflowerblue|darkolivegreen|lightslategray|lightslategrey|lightsteelblue|mediumseagreen|darkgoldenrod|darkslateblue|darkslategray|darkslategrey|darkturquoise|lavenderblush|lightseagreen|palegoldenrod|paleturquoise|palevioletred|rebeccapurple|antiquewhite|darkseagreen|lemonchiffon|lightskyblue|mediumorchid|mediumpurple|midnightblue|darkmagenta|deepskyblue|floralwhite|forestgreen|greenyellow|lightsalmon|lightyellow|navajowhite|saddlebrown|springgreen|yellowgreen|aquamarine|blueviolet|chartreuse|darkorange|darkorchid|darksalmon|darkviolet|dodgerblue|ghostwhite|lightcoral|lightgreen|mediumblue|papayawhip|powderblue|sandybrown|whitesmoke|aliceblue|burlywood|cadetblue|chocolate|darkgreen|darkkhaki|firebrick|gainsboro|goldenrod|indianred|lawngreen|lightblue|lightcyan|lightgray|lightgrey|lightpink|limegreen|mintcream|mistyrose|olivedrab|orangered|palegreen|peachpuff|rosybrown|royalblue|slateblue|slategray|slategrey|steelblue|turquoise|cornsilk|darkblue|darkcyan|darkgray|darkgrey|deeppink|honeydew|lavender|moccasin|seagreen|seashell|crimson|darkred|dimgray|dimgrey|fuchsia|hotpink|magenta|oldlace|skyblue|thistle|bisque|indigo|maroon|orange|orchid|purple|salmon|sienna|silver|tomato|violet|yellow|azure|beige|black|brown|coral|green|ivory|khaki|linen|olive|wheat|white|aqua|blue|cyan|gold|gray|grey|lime|navy|peru|pink|plum|snow|teal|time|red|tan|pi)$")) ; values
(reference
  (path "." (identifier) @variable.other.member))
(member
  name: (identifier) @variable.other.member)
