#include <CLI/CLI.hpp>

#include "app/pages/completion.h"
#include "app/pages/offer.h"

namespace telestrain {
namespace {

// Reads the words before the cursor as the program would: an option takes its values, a verb opens
// its own table, everything else is the next argument. @ is the name of the function.
constexpr const char* kReader = R"(
# row NAME: sets count, kind and choices from the row of an option; fails when there is none.
@_row() {
  local row names
  for row in "${rows[@]}"; do
    read -r names count kind choices <<<"$row"
    [[ ,$names, == *,"$1",* ]] && return 0
  done
  count=0 kind=- choices=
  return 1
}

# argument: the same for the argument that comes next; the last row stands for all further ones when
# it takes any number.
@_argument() {
  local row names
  local -i number=0
  for row in "${rows[@]}"; do
    read -r names count kind choices <<<"$row"
    [[ $names == '*' ]] || continue
    ((number++ == at)) || [[ $count == + ]] && ((number > 0 && at >= number - 1)) && return 0
  done
  return 1
}

@_reply() {
  case $kind in
    files)
      compopt -o filenames 2>/dev/null
      mapfile -t COMPREPLY < <(compgen -f -- "$cur")
      ;;
    folders)
      compopt -o filenames 2>/dev/null
      mapfile -t COMPREPLY < <(compgen -d -- "$cur")
      ;;
    words) mapfile -t COMPREPLY < <(compgen -W "$choices" -- "$cur") ;;
    list)
      local before=
      [[ $cur == *,* ]] && before=${cur%,*},
      compopt -o nospace 2>/dev/null
      mapfile -t COMPREPLY < <(compgen -P "$before" -W "$choices" -- "${cur##*,}")
      ;;
  esac
}

# The names of options, or the verbs.
@_names() {
  local row names words=
  for row in "${rows[@]}"; do
    read -r names count kind choices <<<"$row"
    case $1,$names in
      verbs,verbs) words="$count $kind $choices" ;;
      options,-*) words+=" ${names//,/ }" ;;
    esac
  done
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$cur")
}

@() {
  local IFS=$' \t\n' cur=${COMP_WORDS[COMP_CWORD]} path= word count kind choices
  local -i i left=0 at=0
  local -a rows
  COMPREPLY=()
  [[ $cur == = ]] && cur=
  mapfile -t rows < <(@_table "$path")
  for ((i = 1; i < COMP_CWORD; i++)); do
    word=${COMP_WORDS[i]}
    if [[ $word == = ]]; then
      continue
    elif [[ $word == -?* ]]; then
      @_row "$word"
      left=${count/+/1000}
    elif ((left > 0)); then
      left+=-1
    elif [[ "${rows[0]} " == verbs*" $word "* ]]; then
      path+=${path:+ }$word at=0
      mapfile -t rows < <(@_table "$path")
    else
      at+=1
    fi
  done
  if [[ $cur == -* ]]; then
    @_names options
  elif ((left > 0)) || @_argument; then
    @_reply
  elif [[ ${rows[0]} == 'verbs '* ]]; then
    @_names verbs
  else
    @_names options
  fi
}
complete -F @ )";

std::string KindOf(const OptionFacts& option) {
  switch (OfferOf(option)) {
    case Offer::kFiles:
      return "files";
    case Offer::kFolders:
      return "folders";
    case Offer::kChoices:
      return "words " + Joined(option.choices, " ");
    case Offer::kChoiceList:
      return "list " + Joined(option.choices, " ");
    case Offer::kNothing:
      break;
  }
  return "-";
}

std::string Row(const OptionFacts& option) {
  const bool any_number = option.most_values == OptionFacts::kManyValues;
  return (option.is_argument ? "*" : Joined(option.names, ",")) + " " +
         (any_number ? "+" : std::to_string(option.most_values)) + " " + KindOf(option);
}

// The rows of an app and of the verbs below it, as branches of a case statement.
std::string Branches(const CLI::App& app, const std::string& path) {
  std::string rows, below;
  for (const CLI::App* verb : app.get_subcommands({})) {
    rows += " " + verb->get_name();
    below += Branches(*verb, path + (path.empty() ? "" : " ") + verb->get_name());
  }
  if (!rows.empty()) rows = "      " + ShellQuoted("verbs" + rows) + " \\\n";
  for (const OptionFacts& option : OptionsOf(app))
    rows += "      " + ShellQuoted(Row(option)) + " \\\n";
  rows.erase(rows.size() - 3);  // the last line goes on with ;;
  return "    " + ShellQuoted(path) + ") printf '%s\\n' \\\n" + rows + " ;;\n" + below;
}

std::string FunctionName(const std::string& program) {
  std::string name = "_" + program;
  for (char& c : name)
    if (c == '-') c = '_';
  return name;
}

std::string Replaced(const std::string& text, const std::string& name) {
  std::string all;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool is_array = text[i] == '@' && i > 0 && text[i - 1] == '[';  // "${rows[@]}"
    all += text[i] == '@' && !is_array ? name : std::string(1, text[i]);
  }
  return all;
}

}  // namespace

std::string BashCompletion(const CLI::App& program) {
  const std::string name = FunctionName(program.get_name());
  return "# Completion of " + program.get_name() +
         " for bash; made from its tables of options.\n\n"
         "# A row per option: its names, how many values it takes (+: any number), what they are.\n"
         "# A row with * is an argument, the first one may list the verbs.\n" +
         name + "_table() {\n  case $1 in\n" + Branches(program, "") + "  esac\n}\n" +
         Replaced(kReader, name) + program.get_name() + "\n";
}

}  // namespace telestrain
