#pragma once

#include <string>
#include <unordered_map>

#include "lang/object/object.hpp"

namespace sdlc::lang {

/// A name for a material: "red_matt", "glass", "white_light", by its kind and the nearest CSS
/// colour. Never a name of the language.
std::string describing_name(const MaterialValue& material);

/// Makes unique names: "red_matt", "red_matt_2".
class MaterialNames {
 public:
  std::string name_of(const MaterialValue& material);

 private:
  std::unordered_map<std::string, int> uses_;
};

}  // namespace sdlc::lang
