#pragma once

#include <string>
#include <unordered_map>

#include "lang/object/object.hpp"

namespace sdlc::lang {

/// What a person would call a material: "red_matt", "glass", "white_light", after its kind and the
/// CSS colour nearest to its own. No such name is one of the language's.
std::string describing_name(const MaterialValue& material);

/// Gives names, each once: "red_matt", "red_matt_2".
class MaterialNames {
 public:
  std::string name_of(const MaterialValue& material);

 private:
  std::unordered_map<std::string, int> uses_;
};

}  // namespace sdlc::lang
