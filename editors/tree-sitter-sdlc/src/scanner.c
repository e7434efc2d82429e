// Reads the tokens that a regular expression cannot: words, numbers, colours, the insides of
// strings and nested comments. Each token is as long as that of the program's lexer (lang/token in
// the repository of sdlc). A wrong one is returned as MALFORMED, which no rule has.
//
// No state, no memory, no library: the same code runs in WebAssembly.
#include <tree_sitter/parser.h>

#include "words.h"

// In the order of `externals` in grammar.js, which begin with the words.
enum TokenType {
  IDENTIFIER = SDLC_WORD_COUNT,
  NUMBER,
  VERSION,
  COLOR,
  STRING_CONTENT,
  BLOCK_COMMENT,
  MALFORMED,
  LET_OF_VALUE,
};

static inline void advance(TSLexer* lexer) { lexer->advance(lexer, false); }
static inline void skip(TSLexer* lexer) { lexer->advance(lexer, true); }

static bool is_digit(int32_t c) { return c >= '0' && c <= '9'; }
static bool is_letter(int32_t c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
static bool is_name_character(int32_t c) { return is_letter(c) || is_digit(c); }
static bool is_hex_digit(int32_t c) {
  return is_digit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
}
// Letters of other languages, which continue a name or a number so that it is wrong as a whole.
static bool is_foreign_letter(int32_t c) {
  return c == 0xB5 || (c >= 0xC0 && c <= 0x53F && c != 0xD7 && c != 0xF7);
}

static bool finish(TSLexer* lexer, unsigned symbol) {
  lexer->mark_end(lexer);
  lexer->result_symbol = (TSSymbol)symbol;
  return true;
}

// The index of the text in a table of words; `count` if it is none of them.
static unsigned find_word(const char* const* words, unsigned count, const char* text) {
  for (unsigned i = 0; i < count; ++i) {
    unsigned at = 0;
    while (words[i][at] != '\0' && words[i][at] == text[at]) ++at;
    if (words[i][at] == text[at]) return i;
  }
  return count;
}

// A word of the language in certain places is a name in all others. While the parser recovers from
// a mistake everything is allowed: `scene` is then a name, the others are words.
static bool is_keyword(unsigned word, const bool* valid) {
  if (word < SDLC_RESERVED_COUNT) return true;
  if (word == SDLC_WORD_COUNT || !valid[word]) return false;
  return valid[MALFORMED] ? word > SDLC_RESERVED_COUNT : true;
}

static bool is_word(const char* text, const char* word) {
  return find_word(&word, 1, text) == 0;
}

// Whether the `in` of a `let` before the lexer's place comes before the next statement. A line that
// begins with a name goes on only after an operator or a comma.
static bool has_in(TSLexer* lexer) {
  enum { LOOKAHEAD = 4096 };
  unsigned open = 0, lets = 1, loops = 0;
  bool ends_value = false, is_first = false;
  for (unsigned n = 0; n < LOOKAHEAD && !lexer->eof(lexer); ++n) {
    const int32_t c = lexer->lookahead;
    if (is_letter(c)) {
      char text[SDLC_MAX_WORD + 1];
      unsigned size = 0;
      for (; is_name_character(lexer->lookahead); advance(lexer), ++size) {
        if (size < SDLC_MAX_WORD) text[size] = (char)lexer->lookahead;
      }
      text[size > SDLC_MAX_WORD ? 0 : size] = '\0';
      const bool is_in = is_word(text, "in");
      if (open == 0 && is_in && loops == 0 && --lets == 0) return true;
      if (open == 0 && is_in && loops > 0) --loops;
      const bool continues = is_in || is_word(text, "and") || is_word(text, "or") ||
                             is_word(text, "then") || is_word(text, "else");
      if (open == 0 && is_first && ends_value && !continues) return false;
      lets += open == 0 && is_word(text, "let");
      loops += open == 0 && is_word(text, "for");
      ends_value = !continues && !is_word(text, "not") && !is_word(text, "if") &&
                   !is_word(text, "let");
      is_first = false;
      continue;
    }
    advance(lexer);
    if (c == '\n') is_first = true;
    if (c == ' ' || c == '\t' || c == '\n' || c == '\r') continue;
    if (c == '/' && lexer->lookahead == '/') {
      while (lexer->lookahead != '\n' && !lexer->eof(lexer)) advance(lexer);
      continue;
    }
    if (c == '(' || c == '[' || c == '{') ++open;
    const bool closes = c == ')' || c == ']' || c == '}';
    if (closes && open-- == 0) return false;
    for (; c == '"' && lexer->lookahead != '"' && lexer->lookahead >= 0x20; advance(lexer)) {
      if (lexer->lookahead == '\\') advance(lexer);
    }
    if (c == '"' && lexer->lookahead == '"') advance(lexer);
    ends_value = closes || c == '"' || is_digit(c);
    is_first = false;
  }
  return !lexer->eof(lexer);
}

// `let`, the word with this index.
static bool scan_let(TSLexer* lexer, unsigned word, bool is_first_of_line, const bool* valid) {
  lexer->mark_end(lexer);
  const bool is_of_value = valid[LET_OF_VALUE] && !valid[MALFORMED];
  const bool is_let_in = is_of_value && (!is_first_of_line || has_in(lexer));
  lexer->result_symbol = (TSSymbol)(is_let_in ? LET_OF_VALUE : word);
  return true;
}

static bool scan_word(TSLexer* lexer, bool is_first_of_line, const bool* valid) {
  char text[SDLC_MAX_WORD + 1];
  unsigned size = 0;
  bool is_malformed = false;
  for (; is_name_character(lexer->lookahead) || is_foreign_letter(lexer->lookahead);
       advance(lexer)) {
    if (is_foreign_letter(lexer->lookahead)) is_malformed = true;
    if (size < SDLC_MAX_WORD) text[size] = (char)lexer->lookahead;
    ++size;
  }
  if (is_malformed) return finish(lexer, MALFORMED);
  if (size > SDLC_MAX_WORD) return finish(lexer, IDENTIFIER);
  text[size] = '\0';
  const unsigned word = find_word(sdlc_words, SDLC_WORD_COUNT, text);
  if (is_word(text, "let")) return scan_let(lexer, word, is_first_of_line, valid);
  return finish(lexer, is_keyword(word, valid) ? word : IDENTIFIER);
}

// How far a number has been read. It may end in the first four states.
enum NumberState {
  WHOLE,
  FRACTION,
  EXPONENT,
  UNIT,
  POINT,
  EXPONENT_MARK,
  EXPONENT_SIGN,
  UNDERSCORE,
  WRONG,
};

struct Number {
  enum NumberState state;
  enum NumberState before_underscore;
  bool has_digits_only;
  char unit[SDLC_MAX_UNIT + 1];
  unsigned unit_size;
};

static enum NumberState after_digit(const struct Number* number) {
  switch (number->state) {
    case POINT: return FRACTION;
    case EXPONENT_MARK:
    case EXPONENT_SIGN: return EXPONENT;
    case UNDERSCORE: return number->before_underscore;
    case UNIT: return WRONG;
    default: return number->state;
  }
}

static enum NumberState after_letter(struct Number* number, int32_t c) {
  const bool is_after_digit = number->state <= EXPONENT;
  if (c == '_' && is_after_digit) {
    number->before_underscore = number->state;
    return UNDERSCORE;
  }
  if ((c == 'e' || c == 'E') && number->state <= FRACTION) return EXPONENT_MARK;
  if (number->state > UNIT || number->unit_size == SDLC_MAX_UNIT || c >= 0x80) return WRONG;
  number->unit[number->unit_size++] = (char)c;
  return UNIT;
}

static enum NumberState after(struct Number* number, int32_t c) {
  if (is_digit(c)) return after_digit(number);
  number->has_digits_only = false;
  if (c == '.') return number->state == WHOLE ? POINT : WRONG;
  if (c == '+' || c == '-') return number->state == EXPONENT_MARK ? EXPONENT_SIGN : WRONG;
  return after_letter(number, c);
}

static bool is_number(struct Number* number) {
  if (number->state != UNIT) return number->state < UNIT;
  number->unit[number->unit_size] = '\0';
  return find_word(sdlc_units, SDLC_UNIT_COUNT, number->unit) < SDLC_UNIT_COUNT;
}

static unsigned number_token(struct Number* number, const bool* valid) {
  const bool is_version = valid[VERSION] && !valid[MALFORMED];
  if (is_version) return number->has_digits_only ? VERSION : MALFORMED;
  return is_number(number) ? NUMBER : MALFORMED;
}

// Whether `c`, which follows `last` and that follows `before`, is a part of the number, correct or
// not.
static bool continues_number(int32_t c, int32_t last, int32_t before) {
  if (c == '+' || c == '-') {
    return (last == 'e' || last == 'E') && (is_digit(before) || before == '.');
  }
  return is_name_character(c) || is_foreign_letter(c) || c == '%' || c == '.';
}

// Reads from the first digit on; the state is POINT if one was before it.
static bool scan_number(TSLexer* lexer, enum NumberState state, const bool* valid) {
  struct Number number = {.state = state, .has_digits_only = state == WHOLE};
  int32_t before = 0, last = 0;
  while (continues_number(lexer->lookahead, last, before)) {
    before = last;
    last = lexer->lookahead;
    lexer->mark_end(lexer);
    advance(lexer);
    // `1..2` is an interval.
    if (last == '.' && lexer->lookahead == '.') {
      lexer->result_symbol = (TSSymbol)number_token(&number, valid);
      return true;
    }
    number.state = after(&number, last);
  }
  return finish(lexer, number_token(&number, valid));
}

static bool scan_point(TSLexer* lexer, const bool* valid) {
  advance(lexer);
  return is_digit(lexer->lookahead) && scan_number(lexer, POINT, valid);
}

static bool scan_color(TSLexer* lexer) {
  advance(lexer);
  unsigned size = 0;
  bool is_hex = true;
  for (; is_name_character(lexer->lookahead); advance(lexer)) {
    is_hex = is_hex && is_hex_digit(lexer->lookahead);
    ++size;
  }
  if (size == 0) return false;
  return finish(lexer, is_hex && (size == 3 || size == 6) ? COLOR : MALFORMED);
}

static bool scan_string_content(TSLexer* lexer) {
  bool has_content = false;
  while (lexer->lookahead >= 0x20 && lexer->lookahead != '"' && lexer->lookahead != '\\') {
    advance(lexer);
    has_content = true;
  }
  return has_content && finish(lexer, STRING_CONTENT);
}

static bool scan_block_comment(TSLexer* lexer) {
  advance(lexer);
  if (lexer->lookahead != '*') return false;
  advance(lexer);
  for (uint32_t depth = 1; !lexer->eof(lexer);) {
    const int32_t c = lexer->lookahead;
    advance(lexer);
    if (c == '/' && lexer->lookahead == '*') {
      advance(lexer);
      ++depth;
    } else if (c == '*' && lexer->lookahead == '/') {
      advance(lexer);
      if (--depth == 0) return finish(lexer, BLOCK_COMMENT);
    }
  }
  return finish(lexer, MALFORMED);
}

// False at a carriage return that no line feed follows: it is no space.
static bool skip_spaces(TSLexer* lexer, bool* has_line_end) {
  for (;;) {
    const int32_t c = lexer->lookahead;
    *has_line_end = *has_line_end || c == '\n';
    if (c != ' ' && c != '\t' && c != '\n' && c != '\r') return true;
    skip(lexer);
    if (c == '\r' && lexer->lookahead != '\n') return false;
  }
}

void* tree_sitter_sdlc_external_scanner_create(void) { return 0; }
void tree_sitter_sdlc_external_scanner_destroy(void* payload) { (void)payload; }
unsigned tree_sitter_sdlc_external_scanner_serialize(void* payload, char* buffer) {
  (void)payload, (void)buffer;
  return 0;
}
void tree_sitter_sdlc_external_scanner_deserialize(void* payload, const char* buffer,
                                                   unsigned length) {
  (void)payload, (void)buffer, (void)length;
}

bool tree_sitter_sdlc_external_scanner_scan(void* payload, TSLexer* lexer, const bool* valid) {
  (void)payload;
  if (valid[STRING_CONTENT] && !valid[MALFORMED]) return scan_string_content(lexer);
  bool is_first_of_line = false;
  if (!skip_spaces(lexer, &is_first_of_line)) return false;
  const int32_t c = lexer->lookahead;
  if (is_letter(c) || is_foreign_letter(c)) return scan_word(lexer, is_first_of_line, valid);
  if (is_digit(c)) return scan_number(lexer, WHOLE, valid);
  if (c == '.') return scan_point(lexer, valid);
  if (c == '#') return scan_color(lexer);
  if (c == '/') return scan_block_comment(lexer);
  return false;
}
