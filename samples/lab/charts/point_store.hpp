// SPDX-License-Identifier: MIT
// Finished points in a folder, so that a chart that was interrupted goes on where it stopped.
#pragma once

#include "lab/charts/point.hpp"
#include "lab/images/image_files.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace rebound::charts {

// Everything that a point depends on, and the name of its files: readable, and with a hash of the key.
struct PointKey {
    Json key;
    std::string name;

    // title: what the name begins with.
    PointKey(Json everything, const std::string& title);
};

// Letters, digits and dashes; all else becomes a dash.
std::string fileNameOf(const std::string& text);

// What is shown of a point.
struct PointPictures {
    lab::Image light;   // as EXR
    lab::Picture shown; // light, through its view's tone curve
    lab::Picture error;
    lab::Picture smallShown; // for the page
    lab::Picture smallError;
};

class PointStore {
public:
    // Creates the folder's points/ and pictures/. fresh: forgets all finished points. Fails where points are of another
    // version or format, or cannot be read.
    static Result<PointStore> open(const std::filesystem::path& folder, const std::string& version,
                                   bool fresh);

    // The finished point of that key.
    std::optional<Point> find(const PointKey&) const;

    // Its JSON file comes last: where there is one, all the others are there too.
    Result<> save(const PointKey&, const Point&, const PointPictures&) const;

    // The light of a finished point.
    Result<lab::Image> readLight(const std::string& name) const {
        return lab::readExr(folder / "points" / (name + ".exr"));
    }

    std::filesystem::path picturePath(const std::string& name) const { return folder / "pictures" / name; }

private:
    PointStore(std::filesystem::path f, std::string v) : folder(std::move(f)), version(std::move(v)) {}
    Result<> read(const std::filesystem::path& file);

    std::filesystem::path folder;
    std::string version;
    std::map<std::string, std::pair<nlohmann::json, Point>> finished; // by name
};

} // namespace rebound::charts
