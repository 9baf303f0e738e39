#include "deck/commands/pair_style.hpp"

#include <array>

#include "deck/commands/reading.hpp"
#include "liggghts_plugin/deck_keywords.hpp"

namespace granulaw::deck {

namespace {

void set_model(Scene& scene, Words& w)
{
  const std::string model = w.word();
  if (scene.model.empty()) scene.model = model;
}

void set_law(Scene& scene, Words& w)
{
  scene.law_file = w.path();
}

void set_stretch(Scene& scene, Words& w)
{
  scene.stretch = w.value();
}

void set_materials(Scene& scene, Words& w)
{
  scene.material_names.clear();
  while (w.more() && !plugin::is_reserved(w.peek(), false)) scene.material_names.push_back(w.word());
}

struct Keyword
{
  std::string_view name;
  void (*set)(Scene& scene, Words& words);
};

/// The keywords that bear on a plan: a new one is a line here and a function above.
constexpr std::array keywords{Keyword{"law", set_law}, Keyword{"materials", set_materials},
                              Keyword{"model", set_model}, Keyword{"stretch", set_stretch}};

}  // namespace

void follow_pair_style(Reading& reading, Words w)
{
  while (w.more()) {
    const std::string& name = w.word();
    const auto found =
        std::find_if(keywords.begin(), keywords.end(), [&](const Keyword& k) { return k.name == name; });
    if (!w.more()) return;
    if (found != keywords.end())
      found->set(reading.scene, w);
    else if (plugin::find_keyword(name, false))
      w.word();  // its value has no bearing on a plan
  }
}

}  // namespace granulaw::deck
