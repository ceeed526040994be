# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.audio_common_msgs as _msg_audio_common_msgs
import aioros1.msg.std_msgs as _msg_std_msgs

class AudioData(_t.Message):
    data: _t.OctetArray
    @_ty.overload
    def __init__(self, *, data: _t.Octets = ...) -> None: ...
    @_ty.overload
    def __init__(self, data: _t.Octets, /) -> None: ...

class AudioDataStamped(_t.Message):
    header: _msg_std_msgs.Header
    audio: _msg_audio_common_msgs.AudioData
    @_ty.overload
    def __init__(
        self,
        *,
        header: _msg_std_msgs.Header = ...,
        audio: _msg_audio_common_msgs.AudioData = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        header: _msg_std_msgs.Header,
        audio: _msg_audio_common_msgs.AudioData,
        /,
    ) -> None: ...

class AudioInfo(_t.Message):
    channels: _b.int
    sample_rate: _b.int
    sample_format: _b.str
    bitrate: _b.int
    coding_format: _b.str
    @_ty.overload
    def __init__(
        self,
        *,
        channels: _t.Int = ...,
        sample_rate: _t.Int = ...,
        sample_format: _t.Text = ...,
        bitrate: _t.Int = ...,
        coding_format: _t.Text = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        channels: _t.Int,
        sample_rate: _t.Int,
        sample_format: _t.Text,
        bitrate: _t.Int,
        coding_format: _t.Text,
        /,
    ) -> None: ...
