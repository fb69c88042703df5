// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "oiler/capture/file.hpp"
#include "oiler/core/state_hash.hpp"
#include "oiler/game/game.hpp"
#include "oiler/input/input_event.hpp"

namespace oiler {

/// An action or axis of a recorded game, with the buttons that its player had.
struct RecordedControl : Binding {
    std::string name;

    friend bool operator==(const RecordedControl&, const RecordedControl&) = default;
};

/// Everything besides its input that determines a game.
struct RecordingHeader {
    std::string game;
    std::string version;  ///< of Oiler
    Stepping stepping;
    std::uint64_t seed = 0;
    std::vector<RecordedControl> controls;

    friend bool operator==(const RecordingHeader&, const RecordingHeader&) = default;
};
[[nodiscard]] RecordingHeader header_of(std::string_view game, const Settings& settings,
                                        std::span<const Control> controls);

/// The controls of a game with the buttons of its recording.
[[nodiscard]] ChosenControls controls_of(const RecordingHeader& header,
                                         std::span<const Control> of_game);

/// The last 16 bits of the hashes of a game. The hash that differs tells which part differs.
struct PartHashes {
    std::uint16_t bodies = 0;
    std::uint16_t whole = 0;
    friend bool operator==(const PartHashes&, const PartHashes&) = default;
};
[[nodiscard]] PartHashes part_hashes(const AnyGame& game);

/// Writes a recording: a line "OILERREC 3", a line of JSON, and chunks of records. A chunk is
/// written at least once per second of play, so that a killed program leaves a recording up to
/// there. A chunk has its size (4 bytes), a seal, records, and a seal. A seal is the XXH3 hash of
/// the file up to there (8 bytes). A record has the steps since the last one, a byte that names the
/// kind, and numbers. engine/README.md lists them.
class RecordingWriter {
public:
    /// After the first second the recording is in part_of(path), which a killed program leaves; an
    /// older file stays as it is until `finish`. Throws Error{io} or Error{usage} if the file cannot
    /// be written.
    RecordingWriter(const std::filesystem::path& path, const RecordingHeader& header);

    /// Records the input of a step, before it.
    void add(std::int64_t step, const Input& input);
    /// Records the hashes after that step. With more than 1000 bodies, only some steps are hashed:
    /// about 1000 bodies per step, and the last step of each second.
    void add_state(std::int64_t step, const AnyGame& game);
    /// Completes the file, or leaves it alone if no step was taken. The game is in its state after
    /// `steps` steps, unless it diverged.
    void finish(std::int64_t steps, const AnyGame& game, bool diverged = false);

private:
    void begin_record(std::int64_t step);
    void add_hashes(std::int64_t step, const AnyGame& game);
    void write_chunk();
    void write(std::string_view bytes);
    void write_seal();

    std::filesystem::path path_;
    std::string head_;          ///< the first two lines
    std::optional<File> file_;  ///< from the first chunk on
    StateHash written_;         ///< the hash of the file
    std::int64_t steps_per_second_;
    std::int64_t hashed_step_ = -1;
    std::string records_;
    std::int64_t last_step_ = 0;
    Input before_;
};

/// A recording as it was read.
struct Recording {
    struct Event {
        std::int64_t step;
        InputEvent event;
    };
    RecordingHeader header;
    std::vector<Event> events;
    std::map<std::int64_t, PartHashes> states;  ///< after a step
    std::int64_t steps = 0;
    bool complete = false;  ///< false: its program was killed, or the file cut
    bool quits = false;     ///< the game quits after these steps
};

/// Throws Error{usage} with the reason for a file that is no recording, or a damaged one.
[[nodiscard]] Recording read_recording(const std::filesystem::path& path);
/// Throws Error{usage} if another game, version or table of controls was recorded.
void require_same_game(const RecordingHeader& recorded, const RecordingHeader& now,
                       bool other_version_too);

}  // namespace oiler
