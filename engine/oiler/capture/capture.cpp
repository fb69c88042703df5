// SPDX-License-Identifier: MIT
#include "oiler/capture/capture.hpp"

#include <algorithm>
#include <cassert>
#include <system_error>
#include <utility>

#include "oiler/capture/frame_record.hpp"
#include "oiler/capture/png.hpp"
#include "oiler/core/error.hpp"
#include "oiler/core/team.hpp"

namespace oiler {
namespace {

namespace fs = std::filesystem;

/// As many as there are cores: where encoding takes longest, the thread that draws waits. More than
/// eight threads wait for the drawing. If the machine gives none, the thread that draws writes.
unsigned worker_count() { return std::clamp(std::thread::hardware_concurrency(), 1U, 8U); }

}  // namespace

Capture::Capture(fs::path folder, Manifest header, Profile* profile)
    : folder_(std::move(folder), header.scene), manifest_(std::move(header)), profile_(profile) {
    assert(manifest_.frames.empty());
    folder_.clear();
    write_manifest();
    start_threads(workers_, worker_count(), [this](std::size_t) { work(); });
}

Capture::~Capture() {
    stop_workers();
    drop_incomplete();
    std::error_code ignored;
    if (manifest_.frames.empty()) fs::remove(folder_.file(manifest_name), ignored);
}

void Capture::add(Shot shot) {
    const std::size_t index = manifest_.frames.size();
    if (shot.record) shot.record->index = static_cast<std::int64_t>(index);
    std::unique_lock lock(mutex_);
    const std::size_t most_jobs = std::max<std::size_t>(1, workers_.size());
    changed_.wait(lock, [&] { return error_ || jobs_.size() < most_jobs; });
    if (error_) std::rethrow_exception(error_);
    manifest_.frames.push_back({.index = static_cast<std::int64_t>(index),
                                .file = shot.has_png ? frame_name(std::int64_t(index)) : "",
                                .tick = shot.tick,
                                .alpha = shot.alpha,
                                .state_hash = shot.state_hash,
                                .picture_hash = shot.picture_hash,
                                .tick_hashes = std::move(shot.tick_hashes)});
    complete_.push_back(false);
    jobs_.push_back({index, std::move(shot)});
    changed_.notify_all();
    if (workers_.empty()) write_next(lock);
}

std::vector<std::uint8_t> Capture::spare_buffer() {
    const std::lock_guard lock(mutex_);
    if (spare_.empty()) return {};
    std::vector<std::uint8_t> buffer = std::move(spare_.back());
    spare_.pop_back();
    return buffer;
}

void Capture::work() {
    while (true) {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return closed_ || !jobs_.empty(); });
        if (jobs_.empty()) return;
        write_next(lock);
    }
}

void Capture::write_next(std::unique_lock<std::mutex>& lock) {
    Job job = std::move(jobs_.front());
    jobs_.pop_front();
    lock.unlock();
    changed_.notify_all();
    try {
        write(job);
    } catch (...) {
        const std::lock_guard relock(mutex_);
        if (!error_) error_ = std::current_exception();
        changed_.notify_all();
    }
}

void Capture::write(Job& job) {
    folder_.require_present();
    const auto hash = [&] {
        const Span span(profile_, "hash");
        return hash_top_down(manifest_.size, job.shot.rgb);
    }();
    if (job.shot.has_png) {
        std::vector<std::byte> png;
        {
            const Span span(profile_, "encode");
            png = encode_png(manifest_.size, job.shot.rgb);
        }
        const Span span(profile_, "write");
        write_file(folder_.file(frame_name(std::int64_t(job.index))), png, kinds::png,
                   Links::replaced);
    }
    std::vector<std::byte> record;
    if (job.shot.record) {
        const Span span(profile_, "record");
        record = gzip(to_json(*job.shot.record));
    }
    const std::lock_guard lock(mutex_);
    write_record(job.index, std::move(record));
    manifest_.frames[job.index].pixel_hash = hash;
    complete_[job.index] = true;
    spare_.push_back(std::move(job.shot.rgb));
}

void Capture::write_record(std::size_t index, std::vector<std::byte> record) {
    waiting_records_[index] = std::move(record);
    for (auto next = waiting_records_.begin();
         next != waiting_records_.end() && next->first == next_record_;
         next = waiting_records_.erase(next), ++next_record_) {
        if (next->second.empty()) continue;
        if (!records_) records_.emplace(folder_.file(records_name), kinds::any, Links::replaced);
        records_->write(next->second);
    }
}

void Capture::write_manifest() const {
    File file(folder_.file(manifest_name), kinds::any, Links::replaced);
    file.write(to_json(manifest_));
    file.commit();
}

void Capture::stop_workers() {
    {
        const std::lock_guard lock(mutex_);
        closed_ = true;
    }
    changed_.notify_all();
    for (std::thread& worker : workers_) worker.join();
    workers_.clear();
}

void Capture::drop_incomplete() {
    const auto first =
        static_cast<std::size_t>(std::ranges::find(complete_, false) - complete_.begin());
    std::error_code ignored;
    for (std::size_t i = first; i < manifest_.frames.size(); ++i)
        if (!manifest_.frames[i].file.empty())
            fs::remove(folder_.file(manifest_.frames[i].file), ignored);
    manifest_.frames.resize(first);
}

void Capture::finish() {
    stop_workers();
    drop_incomplete();
    if (error_) records_.reset();  // a failed write may have left a gap in it
    if (!manifest_.frames.empty()) {
        folder_.require_present();
        if (records_) records_->commit();
        write_manifest();
    }
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
}

}  // namespace oiler
