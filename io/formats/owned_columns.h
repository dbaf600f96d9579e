#pragma once
// Columns that a log owns, for formats whose bytes are not the values themselves.
// Used inside io only.

#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/error.h"
#include "log/log.h"

namespace clsurf::io {

/// More than any log has. The limit bounds time and memory: each name is compared with all earlier ones, and each
/// text column takes hundreds of bytes.
inline constexpr std::size_t most_channels = 4096;

/// Throws InputError: there are more.
inline void refuse_too_many_channels(std::size_t count, const Place& place) {
    if (count > most_channels) throw InputError(place, fmt::format("more than {} channels", most_channels));
}

class OwnedColumns {
public:
    /// Shares ownership of the existing channels of `log`. New channels are added one by one, each of
    /// `log.records` values.
    explicit OwnedColumns(Log& log) : log_(log) {
        store_->before = log.keep_alive;
        log.keep_alive = store_;
    }

    void add(const std::string& name, const std::string& unit, std::vector<double> values) {
        add(name, unit, ScalarType::f64, store_->numbers.emplace_back(std::move(values)).data(), sizeof(double));
    }
    void add(const std::string& name, const std::string& unit, std::vector<std::uint32_t> values) {
        add(name, unit, ScalarType::u32, store_->counts.emplace_back(std::move(values)).data(), sizeof(std::uint32_t));
    }

private:
    struct Store {
        std::deque<std::vector<double>> numbers;
        std::deque<std::vector<std::uint32_t>> counts;
        std::shared_ptr<const void> before;  ///< the previous owner of the log's data
    };
    void add(const std::string& name, const std::string& unit, ScalarType type, const void* data, std::size_t stride) {
        log_.channels.push_back(
            {name, unit, {static_cast<const std::byte*>(data), stride, log_.records, type, false, 1.0, 0.0}});
    }

    Log& log_;
    std::shared_ptr<Store> store_ = std::make_shared<Store>();
};

}  // namespace clsurf::io
