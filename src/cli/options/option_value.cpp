#include "cli/options/option_value.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <type_traits>
#include <typeinfo>
#include <vector>

#include "cli/options/vocabulary.h"
#include "core/spelling.h"

namespace clsurf::cli {
namespace {

template <typename Number>
bool is_number(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    Number number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if constexpr (std::is_floating_point_v<Number>) {
        if (!std::isfinite(number)) return false;
    }
    return error == std::errc() && end == text.data() + text.size();
}

bool is_list_type(const std::type_info& type) {
    return type == typeid(std::vector<std::string>) || type == typeid(std::vector<double>) ||
           type == typeid(std::vector<int>) || type == typeid(std::vector<long>) ||
           type == typeid(std::vector<long long>);
}

// Checked here, so that the message does not mention C++ and -1 does not wrap around to an unsigned number.
void check_number(const std::string& option, const std::type_info& type, const std::string& text) {
    const bool whole = type == typeid(int) || type == typeid(long) || type == typeid(long long) ||
                       type == typeid(std::vector<int>) || type == typeid(std::vector<long>) ||
                       type == typeid(std::vector<long long>);
    const bool counted =
        type == typeid(unsigned) || type == typeid(unsigned long) || type == typeid(unsigned long long);
    const bool real = type == typeid(double) || type == typeid(float) || type == typeid(std::vector<double>);
    const bool good =
        (!whole || is_number<std::int64_t>(text)) && (type != typeid(int) || is_number<std::int32_t>(text)) &&
        (!counted || is_number<std::uint64_t>(text)) && (type != typeid(unsigned) || is_number<std::uint32_t>(text)) &&
        (!real || is_number<double>(text));
    if (good) return;
    throw UsageError("--" + option + ": " + "'" + text + "'" +
                     (real      ? " is not a number"
                      : counted ? " is not a whole number of at least 0, or is too large"
                                : " is not a whole number, or is too large"));
}

void check_word(const std::string& option, const std::string& value_name, const std::string& text) {
    if (!lists_all_words(value_name)) return;
    const std::vector<std::string> words = words_of(value_name);
    std::string list;
    for (const std::string& word : words) {
        if (word == text) return;
        list += (list.empty() ? "" : ", ") + word;
    }
    const std::vector<std::string_view> views(words.begin(), words.end());
    throw UsageError("--" + option + ": " + "'" + text + "'" + " is not one of " + list, did_you_mean(text, views));
}

}  // namespace

bool is_a_number(const std::string& text) { return is_number<double>(text); }

bool takes_a_list(const po::typed_value_base& type) { return is_list_type(type.value_type()); }

void check_option(const po::option& option, const po::option_description& description) {
    const auto* typed = dynamic_cast<const po::typed_value_base*>(description.semantic().get());
    if (typed == nullptr) return;
    for (const std::string& text : option.value) {
        check_number(option.string_key, typed->value_type(), text);
        check_word(option.string_key, description.format_parameter(), text);
    }
}

}  // namespace clsurf::cli
