// A component is a header with the source of its name. Components include each other without cycles, so that each can
// be read and tested after those that it needs.

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <set>

#include "architecture/sources.h"

namespace clsurf::test::components_test {
namespace {

using Graph = std::map<std::string, std::set<std::string>>;  // component → components that it includes

std::string component_of(const std::string& path) { return path.substr(0, path.rfind('.')); }

Graph graph_of(const std::vector<SourceFile>& files) {
    std::set<std::string> paths;
    for (const SourceFile& file : files) paths.insert(file.path);
    Graph graph;
    for (const SourceFile& file : files) {
        std::set<std::string>& included = graph[component_of(file.path)];
        for (const Include& include : includes_of(file)) {
            for (const std::string& path : {"src/" + include.header, include.header}) {
                if (paths.contains(path) && component_of(path) != component_of(file.path))
                    included.insert(component_of(path));
            }
        }
    }
    return graph;
}

/// Depth first; an arrow to an unfinished component closes a cycle.
Complaints check_cycles(const Graph& graph) {
    Complaints complaints;
    std::map<std::string, bool> finished;
    std::vector<std::string> path;
    const std::function<void(const std::string&)> visit = [&](const std::string& component) {
        finished[component] = false;
        path.push_back(component);
        for (const std::string& next : graph.at(component)) {
            const auto seen = finished.find(next);
            if (seen == finished.end()) {
                visit(next);
            } else if (!seen->second) {
                const auto first = std::find(path.begin(), path.end(), next);
                std::string cycle;
                for (auto at = first; at != path.end(); ++at) cycle += *at + " includes ";
                complaints.push_back(cycle + next);
            }
        }
        path.pop_back();
        finished[component] = true;
    };
    for (const auto& [component, included] : graph) {
        if (!finished.contains(component)) visit(component);
    }
    return complaints;
}

std::string folder_of(const std::string& path) { return path.substr(0, path.rfind('/')); }

/// The folders inside rooms ("src/simulation/plan"), and the other folders of the room that they include.
Graph folders_of(const std::vector<SourceFile>& files) {
    Graph graph;
    for (const auto& [component, included] : graph_of(files)) {
        const std::string folder = folder_of(component), room = folder_of(folder);
        std::set<std::string>& needs = graph[folder];
        for (const std::string& other : included) {
            const std::string theirs = folder_of(other);
            if (theirs == folder || folder_of(theirs) != room || room == "src") continue;
            needs.insert(theirs);
            graph[theirs];
        }
    }
    return graph;
}

TEST(Components, ACycleIsFound) {
    const std::vector<SourceFile> files{{"src/a/x.h", "#pragma once\n"},
                                        {"src/a/x.cpp", "#include \"a/x.h\"\n#include \"a/y.h\"\n"},
                                        {"src/a/y.h", "#include \"a/z.h\"\n"},
                                        {"src/a/z.h", "#include \"a/x.h\"\n"}};
    EXPECT_EQ(check_cycles(graph_of(files)), Complaints{"src/a/x includes src/a/y includes src/a/z includes src/a/x"});
}

TEST(Components, IncludeEachOtherWithoutCycles) {
    expect_none(check_cycles(graph_of(sources_in({"src", "io", "viz"}))));
}

TEST(Folders, ACycleInsideARoomIsFound) {
    const std::vector<SourceFile> files{{"src/a/plan/x.h", "#include \"a/run/y.h\"\n"},
                                        {"src/a/run/y.h", ""},
                                        {"src/a/run/z.cpp", "#include \"a/plan/w.h\"\n#include \"b/plan/v.h\"\n"},
                                        {"src/a/plan/w.h", ""},
                                        {"src/b/plan/v.h", "#include \"a/top.h\"\n"},
                                        {"src/a/top.h", "#include \"a/plan/x.h\"\n"}};
    EXPECT_TRUE(check_cycles(graph_of(files)).empty());
    EXPECT_EQ(check_cycles(folders_of(files)), Complaints{"src/a/plan includes src/a/run includes src/a/plan"});
}

TEST(Folders, IncludeEachOtherWithoutCycles) {
    const Graph graph = folders_of(sources_in({"src", "io", "viz"}));
    EXPECT_TRUE(graph.contains("src/simulation/plan") && graph.contains("io/formats"));
    expect_none(check_cycles(graph));
}

}  // namespace
}  // namespace clsurf::test::components_test
