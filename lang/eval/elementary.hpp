#pragma once

/// Elementary functions made of + - * / alone, so that their bits are the same on every machine.
namespace sdlc::lang {

/// x^y for finite x > 0 and finite y, computed to about 96 bits and then rounded: the nearest
/// double but where x^y lies within 2^-40 of an ulp from the middle of two. Infinity where it is
/// too large.
double power(double x, double y) noexcept;

}  // namespace sdlc::lang
