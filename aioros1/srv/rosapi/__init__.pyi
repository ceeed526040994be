# Made by aioros1 from message definitions. Change those, and have it made anew.
import builtins as _b
import typing as _ty

import aioros1.idl._typing as _t
import aioros1.msg.rosapi as _msg_rosapi

class DeleteParamRequest(_t.Message):
    name: _b.str
    @_ty.overload
    def __init__(self, *, name: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, name: _t.Text, /) -> None: ...

class DeleteParamResponse(_t.Message):
    def __init__(self) -> None: ...

class DeleteParam(_t.Service[DeleteParamRequest, DeleteParamResponse]):
    Request: _ty.TypeAlias = DeleteParamRequest
    Response: _ty.TypeAlias = DeleteParamResponse

class GetActionServersRequest(_t.Message):
    def __init__(self) -> None: ...

class GetActionServersResponse(_t.Message):
    action_servers: _t.TextList
    @_ty.overload
    def __init__(self, *, action_servers: _t.Texts = ...) -> None: ...
    @_ty.overload
    def __init__(self, action_servers: _t.Texts, /) -> None: ...

class GetActionServers(_t.Service[GetActionServersRequest, GetActionServersResponse]):
    Request: _ty.TypeAlias = GetActionServersRequest
    Response: _ty.TypeAlias = GetActionServersResponse

class GetParamRequest(_t.Message):
    name: _b.str
    default: _b.str
    @_ty.overload
    def __init__(self, *, name: _t.Text = ..., default: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, name: _t.Text, default: _t.Text, /) -> None: ...

class GetParamResponse(_t.Message):
    value: _b.str
    @_ty.overload
    def __init__(self, *, value: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, value: _t.Text, /) -> None: ...

class GetParam(_t.Service[GetParamRequest, GetParamResponse]):
    Request: _ty.TypeAlias = GetParamRequest
    Response: _ty.TypeAlias = GetParamResponse

class GetParamNamesRequest(_t.Message):
    def __init__(self) -> None: ...

class GetParamNamesResponse(_t.Message):
    names: _t.TextList
    @_ty.overload
    def __init__(self, *, names: _t.Texts = ...) -> None: ...
    @_ty.overload
    def __init__(self, names: _t.Texts, /) -> None: ...

class GetParamNames(_t.Service[GetParamNamesRequest, GetParamNamesResponse]):
    Request: _ty.TypeAlias = GetParamNamesRequest
    Response: _ty.TypeAlias = GetParamNamesResponse

class GetTimeRequest(_t.Message):
    def __init__(self) -> None: ...

class GetTimeResponse(_t.Message):
    time: _t.Time
    @_ty.overload
    def __init__(self, *, time: _t.Time = ...) -> None: ...
    @_ty.overload
    def __init__(self, time: _t.Time, /) -> None: ...

class GetTime(_t.Service[GetTimeRequest, GetTimeResponse]):
    Request: _ty.TypeAlias = GetTimeRequest
    Response: _ty.TypeAlias = GetTimeResponse

class HasParamRequest(_t.Message):
    name: _b.str
    @_ty.overload
    def __init__(self, *, name: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, name: _t.Text, /) -> None: ...

class HasParamResponse(_t.Message):
    exists: _b.bool
    @_ty.overload
    def __init__(self, *, exists: _t.Bool = ...) -> None: ...
    @_ty.overload
    def __init__(self, exists: _t.Bool, /) -> None: ...

class HasParam(_t.Service[HasParamRequest, HasParamResponse]):
    Request: _ty.TypeAlias = HasParamRequest
    Response: _ty.TypeAlias = HasParamResponse

class MessageDetailsRequest(_t.Message):
    type: _b.str
    @_ty.overload
    def __init__(self, *, type: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, type: _t.Text, /) -> None: ...

class MessageDetailsResponse(_t.Message):
    typedefs: _t.ItemList[_msg_rosapi.TypeDef]
    @_ty.overload
    def __init__(self, *, typedefs: _t.Items[_msg_rosapi.TypeDef] = ...) -> None: ...
    @_ty.overload
    def __init__(self, typedefs: _t.Items[_msg_rosapi.TypeDef], /) -> None: ...

class MessageDetails(_t.Service[MessageDetailsRequest, MessageDetailsResponse]):
    Request: _ty.TypeAlias = MessageDetailsRequest
    Response: _ty.TypeAlias = MessageDetailsResponse

class NodeDetailsRequest(_t.Message):
    node: _b.str
    @_ty.overload
    def __init__(self, *, node: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, node: _t.Text, /) -> None: ...

class NodeDetailsResponse(_t.Message):
    subscribing: _t.TextList
    publishing: _t.TextList
    services: _t.TextList
    @_ty.overload
    def __init__(
        self,
        *,
        subscribing: _t.Texts = ...,
        publishing: _t.Texts = ...,
        services: _t.Texts = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        subscribing: _t.Texts,
        publishing: _t.Texts,
        services: _t.Texts,
        /,
    ) -> None: ...

class NodeDetails(_t.Service[NodeDetailsRequest, NodeDetailsResponse]):
    Request: _ty.TypeAlias = NodeDetailsRequest
    Response: _ty.TypeAlias = NodeDetailsResponse

class NodesRequest(_t.Message):
    def __init__(self) -> None: ...

class NodesResponse(_t.Message):
    nodes: _t.TextList
    @_ty.overload
    def __init__(self, *, nodes: _t.Texts = ...) -> None: ...
    @_ty.overload
    def __init__(self, nodes: _t.Texts, /) -> None: ...

class Nodes(_t.Service[NodesRequest, NodesResponse]):
    Request: _ty.TypeAlias = NodesRequest
    Response: _ty.TypeAlias = NodesResponse

class PublishersRequest(_t.Message):
    topic: _b.str
    @_ty.overload
    def __init__(self, *, topic: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, topic: _t.Text, /) -> None: ...

class PublishersResponse(_t.Message):
    publishers: _t.TextList
    @_ty.overload
    def __init__(self, *, publishers: _t.Texts = ...) -> None: ...
    @_ty.overload
    def __init__(self, publishers: _t.Texts, /) -> None: ...

class Publishers(_t.Service[PublishersRequest, PublishersResponse]):
    Request: _ty.TypeAlias = PublishersRequest
    Response: _ty.TypeAlias = PublishersResponse

class SearchParamRequest(_t.Message):
    name: _b.str
    @_ty.overload
    def __init__(self, *, name: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, name: _t.Text, /) -> None: ...

class SearchParamResponse(_t.Message):
    global_name: _b.str
    @_ty.overload
    def __init__(self, *, global_name: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, global_name: _t.Text, /) -> None: ...

class SearchParam(_t.Service[SearchParamRequest, SearchParamResponse]):
    Request: _ty.TypeAlias = SearchParamRequest
    Response: _ty.TypeAlias = SearchParamResponse

class ServiceHostRequest(_t.Message):
    service: _b.str
    @_ty.overload
    def __init__(self, *, service: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, service: _t.Text, /) -> None: ...

class ServiceHostResponse(_t.Message):
    host: _b.str
    @_ty.overload
    def __init__(self, *, host: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, host: _t.Text, /) -> None: ...

class ServiceHost(_t.Service[ServiceHostRequest, ServiceHostResponse]):
    Request: _ty.TypeAlias = ServiceHostRequest
    Response: _ty.TypeAlias = ServiceHostResponse

class ServiceNodeRequest(_t.Message):
    service: _b.str
    @_ty.overload
    def __init__(self, *, service: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, service: _t.Text, /) -> None: ...

class ServiceNodeResponse(_t.Message):
    node: _b.str
    @_ty.overload
    def __init__(self, *, node: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, node: _t.Text, /) -> None: ...

class ServiceNode(_t.Service[ServiceNodeRequest, ServiceNodeResponse]):
    Request: _ty.TypeAlias = ServiceNodeRequest
    Response: _ty.TypeAlias = ServiceNodeResponse

class ServiceProvidersRequest(_t.Message):
    service: _b.str
    @_ty.overload
    def __init__(self, *, service: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, service: _t.Text, /) -> None: ...

class ServiceProvidersResponse(_t.Message):
    providers: _t.TextList
    @_ty.overload
    def __init__(self, *, providers: _t.Texts = ...) -> None: ...
    @_ty.overload
    def __init__(self, providers: _t.Texts, /) -> None: ...

class ServiceProviders(_t.Service[ServiceProvidersRequest, ServiceProvidersResponse]):
    Request: _ty.TypeAlias = ServiceProvidersRequest
    Response: _ty.TypeAlias = ServiceProvidersResponse

class ServiceRequestDetailsRequest(_t.Message):
    type: _b.str
    @_ty.overload
    def __init__(self, *, type: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, type: _t.Text, /) -> None: ...

class ServiceRequestDetailsResponse(_t.Message):
    typedefs: _t.ItemList[_msg_rosapi.TypeDef]
    @_ty.overload
    def __init__(self, *, typedefs: _t.Items[_msg_rosapi.TypeDef] = ...) -> None: ...
    @_ty.overload
    def __init__(self, typedefs: _t.Items[_msg_rosapi.TypeDef], /) -> None: ...

class ServiceRequestDetails(_t.Service[ServiceRequestDetailsRequest, ServiceRequestDetailsResponse]):
    Request: _ty.TypeAlias = ServiceRequestDetailsRequest
    Response: _ty.TypeAlias = ServiceRequestDetailsResponse

class ServiceResponseDetailsRequest(_t.Message):
    type: _b.str
    @_ty.overload
    def __init__(self, *, type: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, type: _t.Text, /) -> None: ...

class ServiceResponseDetailsResponse(_t.Message):
    typedefs: _t.ItemList[_msg_rosapi.TypeDef]
    @_ty.overload
    def __init__(self, *, typedefs: _t.Items[_msg_rosapi.TypeDef] = ...) -> None: ...
    @_ty.overload
    def __init__(self, typedefs: _t.Items[_msg_rosapi.TypeDef], /) -> None: ...

class ServiceResponseDetails(_t.Service[ServiceResponseDetailsRequest, ServiceResponseDetailsResponse]):
    Request: _ty.TypeAlias = ServiceResponseDetailsRequest
    Response: _ty.TypeAlias = ServiceResponseDetailsResponse

class ServiceTypeRequest(_t.Message):
    service: _b.str
    @_ty.overload
    def __init__(self, *, service: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, service: _t.Text, /) -> None: ...

class ServiceTypeResponse(_t.Message):
    type: _b.str
    @_ty.overload
    def __init__(self, *, type: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, type: _t.Text, /) -> None: ...

class ServiceType(_t.Service[ServiceTypeRequest, ServiceTypeResponse]):
    Request: _ty.TypeAlias = ServiceTypeRequest
    Response: _ty.TypeAlias = ServiceTypeResponse

class ServicesRequest(_t.Message):
    def __init__(self) -> None: ...

class ServicesResponse(_t.Message):
    services: _t.TextList
    @_ty.overload
    def __init__(self, *, services: _t.Texts = ...) -> None: ...
    @_ty.overload
    def __init__(self, services: _t.Texts, /) -> None: ...

class Services(_t.Service[ServicesRequest, ServicesResponse]):
    Request: _ty.TypeAlias = ServicesRequest
    Response: _ty.TypeAlias = ServicesResponse

class ServicesForTypeRequest(_t.Message):
    type: _b.str
    @_ty.overload
    def __init__(self, *, type: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, type: _t.Text, /) -> None: ...

class ServicesForTypeResponse(_t.Message):
    services: _t.TextList
    @_ty.overload
    def __init__(self, *, services: _t.Texts = ...) -> None: ...
    @_ty.overload
    def __init__(self, services: _t.Texts, /) -> None: ...

class ServicesForType(_t.Service[ServicesForTypeRequest, ServicesForTypeResponse]):
    Request: _ty.TypeAlias = ServicesForTypeRequest
    Response: _ty.TypeAlias = ServicesForTypeResponse

class SetParamRequest(_t.Message):
    name: _b.str
    value: _b.str
    @_ty.overload
    def __init__(self, *, name: _t.Text = ..., value: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, name: _t.Text, value: _t.Text, /) -> None: ...

class SetParamResponse(_t.Message):
    def __init__(self) -> None: ...

class SetParam(_t.Service[SetParamRequest, SetParamResponse]):
    Request: _ty.TypeAlias = SetParamRequest
    Response: _ty.TypeAlias = SetParamResponse

class SubscribersRequest(_t.Message):
    topic: _b.str
    @_ty.overload
    def __init__(self, *, topic: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, topic: _t.Text, /) -> None: ...

class SubscribersResponse(_t.Message):
    subscribers: _t.TextList
    @_ty.overload
    def __init__(self, *, subscribers: _t.Texts = ...) -> None: ...
    @_ty.overload
    def __init__(self, subscribers: _t.Texts, /) -> None: ...

class Subscribers(_t.Service[SubscribersRequest, SubscribersResponse]):
    Request: _ty.TypeAlias = SubscribersRequest
    Response: _ty.TypeAlias = SubscribersResponse

class TopicTypeRequest(_t.Message):
    topic: _b.str
    @_ty.overload
    def __init__(self, *, topic: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, topic: _t.Text, /) -> None: ...

class TopicTypeResponse(_t.Message):
    type: _b.str
    @_ty.overload
    def __init__(self, *, type: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, type: _t.Text, /) -> None: ...

class TopicType(_t.Service[TopicTypeRequest, TopicTypeResponse]):
    Request: _ty.TypeAlias = TopicTypeRequest
    Response: _ty.TypeAlias = TopicTypeResponse

class TopicsRequest(_t.Message):
    def __init__(self) -> None: ...

class TopicsResponse(_t.Message):
    topics: _t.TextList
    types: _t.TextList
    @_ty.overload
    def __init__(self, *, topics: _t.Texts = ..., types: _t.Texts = ...) -> None: ...
    @_ty.overload
    def __init__(self, topics: _t.Texts, types: _t.Texts, /) -> None: ...

class Topics(_t.Service[TopicsRequest, TopicsResponse]):
    Request: _ty.TypeAlias = TopicsRequest
    Response: _ty.TypeAlias = TopicsResponse

class TopicsAndRawTypesRequest(_t.Message):
    def __init__(self) -> None: ...

class TopicsAndRawTypesResponse(_t.Message):
    topics: _t.TextList
    types: _t.TextList
    typedefs_full_text: _t.TextList
    @_ty.overload
    def __init__(
        self,
        *,
        topics: _t.Texts = ...,
        types: _t.Texts = ...,
        typedefs_full_text: _t.Texts = ...,
    ) -> None: ...
    @_ty.overload
    def __init__(
        self,
        topics: _t.Texts,
        types: _t.Texts,
        typedefs_full_text: _t.Texts,
        /,
    ) -> None: ...

class TopicsAndRawTypes(_t.Service[TopicsAndRawTypesRequest, TopicsAndRawTypesResponse]):
    Request: _ty.TypeAlias = TopicsAndRawTypesRequest
    Response: _ty.TypeAlias = TopicsAndRawTypesResponse

class TopicsForTypeRequest(_t.Message):
    type: _b.str
    @_ty.overload
    def __init__(self, *, type: _t.Text = ...) -> None: ...
    @_ty.overload
    def __init__(self, type: _t.Text, /) -> None: ...

class TopicsForTypeResponse(_t.Message):
    topics: _t.TextList
    @_ty.overload
    def __init__(self, *, topics: _t.Texts = ...) -> None: ...
    @_ty.overload
    def __init__(self, topics: _t.Texts, /) -> None: ...

class TopicsForType(_t.Service[TopicsForTypeRequest, TopicsForTypeResponse]):
    Request: _ty.TypeAlias = TopicsForTypeRequest
    Response: _ty.TypeAlias = TopicsForTypeResponse
