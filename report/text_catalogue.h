#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>

#include "base/result.h"
#include "report/template_folder.h"

namespace telestrain {

// The texts of a report in one language, keyed by the English ones that the program and the
// layouts hold. English needs none; texts/en.json of the user's folder may still change some.
class TextCatalogue {
 public:
  TextCatalogue() = default;  // English
  // The user's texts/LANGUAGE.json over the built-in one. Fails with kUsage (there is neither; the
  // nearest language is named) or kBadInput (the file, the JSON pointer and what is wrong; a
  // translation must hold the same {{names}} as its pattern).
  static Result<TextCatalogue> Load(const TemplateFolder& folder, const std::string& language);

  // Wordings that go before those of the language: a layout's "labels".
  void AddLabels(const Json& labels);

  const std::string& language() const { return language_; }
  const std::string& between_sentences() const { return between_sentences_; }
  // The text in this language, or nothing.
  std::optional<std::string> Find(const std::string& text) const;
  // The text in this language, or itself; then `on_untranslated` gets it.
  std::string Say(const std::string& text) const;
  // A cell: a text or a printed number as they are where they have no translation, for they may be
  // a name or a value; a Phrase by its pattern, with its values.
  std::string SayCell(const Json& cell) const;
  // A Phrase or a text by `Say`; a list of them as one paragraph.
  std::string SayPhrase(const Json& phrase) const;

  // Called for every wording that the language lacks; not for English.
  std::function<void(const std::string&)> on_untranslated;

 private:
  Status Add(const TemplateFile& file, const std::string& language);

  std::string language_ = "en", between_sentences_ = " ";
  std::map<std::string, std::string> texts_, labels_;
};

}  // namespace telestrain
