// The scene language of sdlc: grammar/scene.ebnf of the repository, rule by rule, in the same order.
//
// src/scanner.c reads words, numbers, colours, the insides of strings and block comments. It reads
// each as far as the program's own lexer does, so that `5min` or `thenb` is one wrong token and
// never two right ones, and a reserved word is never a name.

// Written by a test of the repository from the program's own tables, as src/words.h for the scanner.
const words = require('./words.json');

const comma_separated = (rule) => seq(rule, repeat(seq(',', rule)), optional(','));

// `else`, `and` and `or` continue what is before them, although each could be the label of the next
// property: what could end there has less precedence.
const last = (rule) => prec.right(-1, rule);

module.exports = grammar({
  name: 'sdlc',

  // In the order of the enumeration in src/scanner.c.
  externals: ($) => [
    ...words.reserved,
    ...words.contextual,
    $.identifier,
    $.number,
    $.version,
    $.color,
    $.string_content,
    $.block_comment,
    // Never part of a rule: a number, name or colour that is none.
    $.malformed,
    // `let` of a value. The statement of the next line is none, where a value is missing.
    $._let_of_value,
  ],

  extras: ($) => [/[ \t\n]|\r\n/, $.doc_comment, $.line_comment, $.block_comment],

  supertypes: ($) => [$._statement, $._expression],

  rules: {
    // The header is optional here, so that a part of a scene in a manual is highlighted too.
    source_file: ($) => seq(optional($.header), repeat(seq($._statement, optional(',')))),
    header: ($) => seq('scene', $.version),

    _statement: ($) =>
      choice(
        $.property,
        $.import_statement,
        $.include_statement,
        $.param_statement,
        $.let_statement,
        $.fn_statement,
        $.def_statement,
        $.assert_statement,
        $.for_statement,
        $.if_statement,
        $.object,
      ),
    property: ($) => seq(field('name', $.label), ':', field('value', $._expression)),
    import_statement: ($) => seq('import', field('file', $.string), 'as', field('name', $.identifier)),
    include_statement: ($) => seq('include', field('file', $.string)),
    param_statement: ($) =>
      seq(
        'param',
        field('name', $.identifier),
        optional(seq(':', field('type', $.type))),
        '=',
        field('default', $._expression),
      ),
    let_statement: ($) => seq('let', field('name', $.identifier), '=', field('value', $._expression)),
    fn_statement: ($) =>
      seq(
        'fn',
        field('name', $.identifier),
        field('parameters', $.parameters),
        '=',
        field('body', $._expression),
      ),
    def_statement: ($) =>
      seq(
        'def',
        field('name', $.identifier),
        field('parameters', $.parameters),
        field('body', $.block),
      ),
    assert_statement: ($) =>
      seq('assert', field('condition', $._expression), ',', field('message', $._expression)),
    for_statement: ($) =>
      seq(
        'for',
        field('pattern', $.pattern),
        'in',
        field('list', $._expression),
        field('body', $.block),
      ),
    pattern: ($) =>
      seq(
        optional(seq(field('index', $.identifier), ',')),
        choice(field('name', $.identifier), $.row_pattern),
      ),
    row_pattern: ($) =>
      seq(
        '(',
        field('name', $.identifier),
        repeat1(seq(',', field('name', $.identifier))),
        optional(','),
        ')',
      ),
    if_statement: ($) =>
      last(
        seq(
          'if',
          field('condition', $._expression),
          field('body', $.block),
          repeat(seq('else', 'if', field('condition', $._expression), field('body', $.block))),
          optional(seq('else', field('body', $.block))),
        ),
      ),
    object: ($) =>
      seq(field('kind', $.path), field('name', optional($.identifier)), field('body', $.block)),
    block: ($) => seq('{', repeat(seq($._statement, optional(','))), '}'),
    type: ($) => $.identifier,
    parameters: ($) => seq('(', optional(comma_separated($.parameter)), ')'),
    parameter: ($) =>
      seq(
        field('name', $.identifier),
        optional(seq(':', field('type', $.type))),
        optional(seq('=', field('default', $._expression))),
      ),
    arguments: ($) => seq('(', optional(comma_separated($._argument)), ')'),
    _argument: ($) => choice($.argument, $._expression),
    argument: ($) => seq(field('name', $.label), ':', field('value', $._expression)),

    // Expressions, loosest first. A chain is one node with all its operands.

    _expression: ($) => choice($.conditional, $.let_in, $._disjunction),
    conditional: ($) =>
      seq(
        'if',
        field('condition', $._expression),
        'then',
        field('value', $._expression),
        repeat(
          seq(
            'else',
            'if',
            field('condition', $._expression),
            'then',
            field('value', $._expression),
          ),
        ),
        'else',
        field('value', choice($.let_in, $._disjunction)),
      ),
    let_in: ($) =>
      seq(
        alias($._let_of_value, 'let'),
        $.binding,
        repeat(seq(',', $.binding)),
        'in',
        field('value', $._expression),
      ),
    binding: ($) => seq(field('name', $.identifier), '=', field('value', $._expression)),
    _disjunction: ($) => choice($.disjunction, last($._conjunction)),
    disjunction: ($) =>
      last(seq($._conjunction, repeat1(seq('or', $._conjunction)))),
    _conjunction: ($) => choice($.conjunction, last($._negation)),
    conjunction: ($) => last(seq($._negation, repeat1(seq('and', $._negation)))),
    _negation: ($) => choice($.negation, $._comparison),
    negation: ($) => seq('not', $._negation),
    _comparison: ($) => choice($.comparison, $._interval),
    comparison: ($) =>
      seq(
        field('left', $._interval),
        field('operator', choice('==', '!=', '<=', '>=', '<', '>')),
        field('right', $._interval),
      ),
    _interval: ($) => choice($.interval, $._sum),
    interval: ($) => seq(field('from', $._sum), '..', field('to', $._sum)),
    _sum: ($) => choice($.sum, $._product),
    sum: ($) => seq($._product, repeat1(seq(choice('+', '-'), $._product))),
    _product: ($) => choice($.product, $._unary),
    product: ($) => seq($._unary, repeat1(seq(choice('*', '/'), $._unary))),
    _unary: ($) => choice($.unary, $._power),
    unary: ($) => seq('-', $._unary),
    _power: ($) => choice($.power, $._operand),
    power: ($) => seq(field('base', $._operand), '^', field('exponent', $._unary)),
    _operand: ($) =>
      choice($._literal, $.list, $.comprehension, $.reference, $.call, $._parenthesis, $.postfix),
    // A path takes all the `.name` after it.
    postfix: ($) =>
      seq(
        choice(
          seq($.reference, $.index),
          seq(choice($.call, $._parenthesis), choice($.member, $.index)),
        ),
        repeat(choice($.member, $.index)),
      ),
    member: ($) => seq('.', field('name', $.identifier)),
    index: ($) => seq('[', $._expression, ']'),
    reference: ($) => $.path,
    call: ($) => seq(field('function', $.path), field('arguments', $.arguments)),
    path: ($) => seq($.identifier, repeat(seq('.', $.identifier))),
    _parenthesis: ($) => choice($.group, $.triple),
    group: ($) => seq('(', $._expression, ')'),
    triple: ($) =>
      seq('(', $._expression, ',', $._expression, ',', $._expression, optional(','), ')'),
    list: ($) => seq('[', optional(comma_separated($._expression)), ']'),
    comprehension: ($) =>
      seq(
        '[',
        field('value', $._expression),
        $.for_clause,
        repeat(choice($.for_clause, $.if_clause)),
        ']',
      ),
    for_clause: ($) =>
      seq('for', field('pattern', $.pattern), 'in', field('list', $._expression)),
    if_clause: ($) => seq('if', field('condition', $._expression)),

    _literal: ($) => choice($.number, $.string, $.color, $.true, $.false),
    label: ($) =>
      choice($.identifier, ...words.reserved.map((word) => alias(word, $.identifier))),
    true: ($) => 'true',
    false: ($) => 'false',
    string: ($) =>
      seq('"', repeat(choice($.string_content, $.escape_sequence)), token.immediate('"')),
    escape_sequence: ($) => token.immediate(/\\(["\\\/bfnrt]|u[0-9a-fA-F]{4})/),

    doc_comment: ($) => token(/\/\/\/([^\/\r\n][^\r\n]*)?/),
    line_comment: ($) => token(/\/\/([^\/\r\n][^\r\n]*|\/\/[^\r\n]*)?/),
  },
});
