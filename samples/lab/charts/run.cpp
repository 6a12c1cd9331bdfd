// SPDX-License-Identifier: MIT
#include "lab/charts/run.hpp"

#include "lab/charts/file_lock.hpp"
#include "lab/charts/pareto.hpp"
#include "lab/charts/pictures.hpp"
#include "lab/charts/source_hashes.hpp"
#include "lab/measure/measurement.hpp"

#include <algorithm>
#include <cstdio>

namespace rebound::charts {

namespace {

// A reference takes about as long as so many points.
constexpr double pointsAReference = 20.0;

class Runner {
public:
    Runner(const ChartRun& what, Workshop& where, PointStore& points)
        : run(what), workshop(where), store(points) {
        const double perView = pointsAReference + double(run.backends.size() * run.sweep.settings.size());
        total = perView * double(run.views.size()) + double(run.peers.size());
    }

    Result<Results> work() {
        results.version = REBOUND_VERSION;
        results.machine = run.machine;
        results.size = run.sweep.size;
        results.bounces = run.sweep.reference.bounces;
        results.sweep = toJson(run.sweep);
        for (const View& view : run.views)
            if (auto done = addView(view); !done) return done.error();
        return results;
    }

private:
    // Shows a step that counts for `weight` points; done() when it is over.
    lab::Progress step(const std::string& what, double weight) {
        if (!run.progress) return {};
        run.progress(what, finished / total);
        return
            [this, what, weight](double share) { run.progress(what, (finished + weight * share) / total); };
    }

    Result<> addView(const View& view) {
        auto truth = workshop.truth(view, step(view.label + ": the reference", pointsAReference));
        if (!truth) return truth.error();
        finished += pointsAReference;
        ViewPictures pictures(*truth);
        const std::string picture = "view-" + fileNameOf(view.label) + "-" + view.contentKey;
        if (auto written = pictures.writeView(store.picturePath(picture).string()); !written) return written;
        results.views.push_back({view.label, view.scene, view.camera.name, truth->samples,
                                 truth->relativeError, pictures.errorScale(), picture});
        for (ChartBackend& backend : run.backends)
            for (const Setting& setting : run.sweep.settings) {
                if (auto done = addPoint(view, backend, setting, pictures); !done) return done;
                finished += 1.0;
            }
        for (const Peer& peer : run.peers)
            if (peer.point.view == view.label)
                if (auto done = addPeer(peer, view, pictures); !done) return done;
        return writeSheet(view, pictures);
    }

    // What the settings on the view's front show, and all peers.
    Result<> writeSheet(const View& view, const ViewPictures& pictures) {
        std::vector<const Point*> points;
        std::vector<SpeedAndError> places;
        for (const Point& point : results.points)
            if (point.view == view.label) {
                points.push_back(&point);
                places.push_back({point.times.median, point.metrics.relativeRmse});
            }
        std::vector<size_t> chosen = paretoFront(places);
        for (size_t i = 0; i < points.size(); ++i)
            if (points[i]->isPeer && std::find(chosen.begin(), chosen.end(), i) == chosen.end())
                chosen.push_back(i);
        std::vector<ViewPictures::Captioned> all;
        for (const size_t i : chosen) {
            auto light = store.readLight(points[i]->picture);
            if (!light) return light.error();
            char figures[80];
            std::snprintf(figures, sizeof figures, ": %.3g ms, relative RMSE %.3g", places[i].milliseconds,
                          places[i].error);
            all.push_back({points[i]->name + " on " + points[i]->backend + figures, *std::move(light)});
        }
        const auto sheet = pictures.sheet(all);
        if (!sheet) return sheet.error();
        return lab::writePng(store.picturePath("sheet-" + fileNameOf(view.label) + ".png"), *sheet);
    }

    Result<> addPoint(const View& view, ChartBackend& backend, const Setting& setting,
                      ViewPictures& pictures) {
        const std::string title = view.label + " " + setting.name + " " + backend.label;
        const auto configured = setting.forCamera(view.camera, run.sweep.size);
        if (!configured) return configured.error();
        const PointKey key(keyOf(view, backend, *setting.technique, *configured), title);
        if (const auto known = store.find(key)) {
            results.points.push_back(*known);
            return {};
        }
        const lab::Progress progress = step(view.label + ", " + setting.name + ", " + backend.label, 1.0);
        auto trial = measureAlone(view, backend, *configured, progress);
        if (!trial) return trial.error();
        Point point;
        point.technique = setting.technique->name;
        point.name = setting.name;
        point.settings = configured->settings;
        point.view = view.label;
        point.backend = backend.label;
        point.device = backend.device;
        point.machine = run.machine;
        const measure::Series series{"frame", std::move(trial->milliseconds)};
        point.times = {series.median(), series.minimum(), series.percentile(10.0), series.percentile(90.0),
                       int(series.milliseconds.size())};
        return finish(key, std::move(point), std::move(trial->light), title, pictures);
    }

    Result<> addPeer(const Peer& peer, const View& view, ViewPictures& pictures) {
        step(view.label + ", " + peer.point.name, 1.0);
        Json key = toJson(peer.point);
        key["content"] = view.contentKey;
        key["folder"] = peer.folder.filename().string();
        const PointKey named(key, view.label + " peer " + peer.point.name);
        finished += 1.0;
        // Compared anew each time, as nothing is measured.
        return finish(named, peer.point, peer.light, peer.folder.string(), pictures);
    }

    // Metrics and pictures.
    Result<> finish(const PointKey& key, Point point, lab::Image light, const std::string& title,
                    ViewPictures& pictures) {
        auto metrics = pictures.compare(light);
        if (!metrics) return Error{metrics.error().code, title + ": " + metrics.error().message};
        point.metrics = *metrics;
        point.picture = key.name;
        auto shown = pictures.show(std::move(light));
        if (!shown) return Error{shown.error().code, title + ": " + shown.error().message};
        if (auto saved = store.save(key, point, *shown); !saved) return saved;
        results.points.push_back(std::move(point));
        return {};
    }

    // Other charts on this machine wait meanwhile.
    Result<Trial> measureAlone(const View& view, ChartBackend& backend,
                               const techniques::Configured& configured, const lab::Progress& progress) {
        const auto lock = FileLock::acquire(measuringLockFile(), FileLock::WhenTaken::wait);
        if (!lock) return lock.error();
        return workshop.measure(view, configured, backend, progress);
    }

    Json keyOf(const View& view, const ChartBackend& backend, const techniques::Technique& technique,
               const techniques::Configured& configured) const {
        Json settings = configured.settings;
        settings.erase("preset"); // where it began does not matter
        return {{"version", REBOUND_VERSION},
                {"technique", technique.name},
                {"settings", settings},
                {"plan", planHash(configured.plan)},
                {"source", backend.source},
                {"content", view.contentKey},
                {"reference", toJson(run.sweep.reference)},
                {"size", {run.sweep.size.width, run.sweep.size.height}},
                {"backend", backend.label},
                {"device", backend.device},
                {"machine", run.machine},
                {"precision", run.precision},
                {"frames", run.sweep.frames},
                {"warm_up", run.sweep.warmUp}};
    }

    const ChartRun& run;
    Workshop& workshop;
    PointStore& store;
    Results results;
    double total = 1.0;
    double finished = 0.0;
};

} // namespace

Result<Results> runChart(const ChartRun& run, Workshop& workshop, PointStore& store) {
    return Runner(run, workshop, store).work();
}

} // namespace rebound::charts
