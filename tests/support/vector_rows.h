#pragma once
// Vectors from independent computations in tests/ROOM/vectors: one case per row of words.

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace clsurf {

/// One case: its name and its words in order.
class VectorRow {
public:
    explicit VectorRow(const std::string& line) : words_(line) { words_ >> name; }
    double number() {
        std::string word;
        words_ >> word;
        return std::stod(word);
    }
    std::vector<double> numbers(int count) {
        std::vector<double> all;
        for (int i = 0; i < count; ++i) all.push_back(number());
        return all;
    }
    std::string word() {
        std::string word;
        words_ >> word;
        return word;
    }
    std::string name;

private:
    std::istringstream words_;
};

inline std::vector<VectorRow> vector_rows(const std::string& room, const std::string& file) {
    std::ifstream stream(std::string(TEST_SOURCES) + "/" + room + "/vectors/" + file);
    std::vector<VectorRow> all;
    for (std::string line; std::getline(stream, line);) {
        if (!line.empty() && line.front() != '#') all.emplace_back(line);
    }
    EXPECT_FALSE(all.empty()) << file;
    return all;
}

}  // namespace clsurf
