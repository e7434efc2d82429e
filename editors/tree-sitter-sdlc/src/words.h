// Written by a test of sdlc from the program's tables; see README.md.
#ifndef TREE_SITTER_SDLC_WORDS_H_
#define TREE_SITTER_SDLC_WORDS_H_

// Reserved words, then those that are names in most places.
static const char *const sdlc_words[] = {
    "let",
    "fn",
    "def",
    "param",
    "import",
    "include",
    "assert",
    "for",
    "if",
    "and",
    "or",
    "then",
    "else",
    "not",
    "true",
    "false",
    "scene",
    "as",
    "in",
};
enum { SDLC_RESERVED_COUNT = 16, SDLC_WORD_COUNT = 19, SDLC_MAX_WORD = 7 };

static const char *const sdlc_units[] = {
    "deg",
    "rad",
    "turn",
    "mm",
    "cm",
    "m",
    "km",
    "ms",
    "s",
    "%",
};
enum { SDLC_UNIT_COUNT = 10, SDLC_MAX_UNIT = 4 };

#endif
