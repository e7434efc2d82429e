#include "lang/convert/config_value.hpp"

namespace sdlc::lang {

std::string ConfigValue::string() const { return unescape(file_->text(node().content())); }

std::vector<ConfigValue> ConfigValue::elements() const {
  std::vector<ConfigValue> all;
  for (std::uint32_t i = node_ + 1; i < node().next; i = (*tape_)[i].next) {
    all.emplace_back(*file_, *tape_, i);
  }
  return all;
}

std::optional<ConfigMember> ConfigValue::find(std::string_view key) const {
  std::string buffer;
  for (std::uint32_t name = node_ + 1; name < node().next; name = (*tape_)[name + 1].next) {
    if (member_name(*file_, (*tape_)[name], buffer) != key) continue;
    if ((*tape_)[name + 1].type == JsonNodeType::Null) return std::nullopt;
    return ConfigMember{.name = {file_, (*tape_)[name].content()},
                        .value = {*file_, *tape_, name + 1}};
  }
  return std::nullopt;
}

std::string ConfigValue::on_one_line() const {
  if (node().type != JsonNodeType::Array) return std::string(spelling());
  std::string text = "[";
  for (const ConfigValue& element : elements()) {
    text += (text.size() > 1 ? ", " : "") + element.on_one_line();
  }
  return text + "]";
}

}  // namespace sdlc::lang
